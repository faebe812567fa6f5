// Certificates of bodies of many parts, as files.
#include "harness/files/parts_certificates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

const std::string every_form =
    R"({"id":"x","a":{"shape":{"type":"mesh","vertices":[[0.0,0.0,0.0],[1.0,0.0,0.0],[0.1,1.0,0.0]],)"
    R"("triangles":[[0,1,2]],"solid":false},"translation":[1.0,0.0,0.0],)"
    R"("rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0]},)"
    R"("b":{"shape":{"type":"sphere","radius":1.0},"translation":[5.0,0.0,0.0],)"
    R"("rotation":[1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0]},)"
    R"("claim":"distance","answer":"separated","bounds":[0.1,0.3],"undecided":7,)"
    R"("order_a":[0],"order_b":[],"cover":["a","b",["1","-2","0"],"own","meet","open"],)"
    R"("met":[{"parts":[0,1],"generators_a":[0,["0x8p-3","0x0p+0","-0x8p-4"]],"generators_b":[1],)"
    R"("closest":[[0,0,"7"]],"surface":{"points":[[0,0]],"triangles":[[0,1,2]]}}],)"
    R"("inside":{"body":"b","part":2,"surface":3}})";

class PartsCertificateFiles : public ::testing::Test {
 protected:
  std::string rewritten(const std::string& text) {
    std::string out;
    files::read_parts_certificates(folder.write("in.jsonl", text),
                                   [&](const files::StoredPartsCertificate& stored, std::int64_t) {
                                     out += to_json(stored) + "\n";
                                   });
    return out;
  }
  std::string changed(const std::string& part, const std::string& other) {
    std::string text = every_form;
    const auto place = text.find(part);
    EXPECT_NE(place, std::string::npos) << part;
    return text.replace(place, part.size(), other);
  }
  void expect_fault(const std::string& part, const std::string& other, const std::string& said) {
    const std::string fault =
        folder.without_path(input_fault([&] { rewritten(changed(part, other)); }));
    EXPECT_THAT(fault, HasSubstr("in.jsonl:1: " + said)) << part;
  }
  TemporaryFolder folder;
};

TEST_F(PartsCertificateFiles, EveryFormIsReadAsItWasWritten) {
  const std::string once = rewritten(every_form);
  EXPECT_EQ(rewritten(once), once);
  for (const std::string part :
       {R"("claim":"distance","answer":"separated","bounds":[0.1,0.3],"undecided":7)",
        R"("order_a":[0],"order_b":[],"cover":["a","b",["1","-2","0"],"own","meet","open"])",
        R"("met":[{"parts":[0,1],"generators_a":[0,[)", R"("closest":[[0,0,"7"]],"surface":)",
        R"("inside":{"body":"b","part":2,"surface":3}})"}) {
    EXPECT_THAT(once, HasSubstr(part));
  }
  const std::string without = rewritten(changed("[0.1,0.3]", "null"));
  EXPECT_THAT(without, HasSubstr("\"bounds\":null"));
  EXPECT_EQ(rewritten(without), without);
  EXPECT_THAT(rewritten(changed(R"({"body":"b","part":2,"surface":3})", "null")),
              HasSubstr("\"inside\":null"));
  for (const std::string name : {"intersect", "contacts"}) {
    EXPECT_THAT(rewritten(changed("distance", name)), HasSubstr(name));
  }
  for (const std::string name : {"overlapping", "unknown"}) {
    EXPECT_THAT(rewritten(changed("separated", name)), HasSubstr(name));
  }
}

// Compounds within compounds keep their poses, where their product was rounded.
TEST_F(PartsCertificateFiles, NestedCompounds) {
  const std::string third =
      R"("translation":[0.1,0.2,0.3],"rotation":[0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9])";
  const auto compound = [&](const std::string& parts) {
    return R"({"shape":{"type":"compound","parts":[)" + parts + "]}," + third + "}";
  };
  const std::string part = R"({"shape":{"type":"sphere","radius":1.0},)" + third + "}";
  const std::string mesh =
      R"({"shape":{"type":"mesh","vertices":[[0.0,0.0,0.0],[1.0,0.0,0.0],[0.1,1.0,0.0]],)"
      R"("triangles":[[0,1,2],[0,2,1]],"solid":true},)" +
      third + "}";
  const std::string nested = compound(compound(part) + "," + compound(mesh) + "," + part);
  std::string text = every_form;
  const auto place = text.find(R"({"shape":{"type":"sphere")");
  text.replace(place, text.find(R"(,"claim")") - place, nested);
  const std::string once = rewritten(text);
  EXPECT_THAT(once, HasSubstr(R"("b":)" + nested));
  EXPECT_EQ(rewritten(once), once);
}

TEST_F(PartsCertificateFiles, WhatIsMalformedIsToldWithItsPlace) {
  for (const std::string key : {"id", "a", "b", "claim", "answer", "bounds", "undecided", "order_a",
                                "order_b", "cover", "met", "inside"}) {
    expect_fault("\"" + key + "\":", "\"x" + key + "\":", "no \"" + key + "\"");
  }
  for (const std::string key :
       {"parts", "generators_a", "generators_b", "closest", "surface", "points"}) {
    expect_fault("\"" + key + "\":", "\"x\":", "met[0]");
  }
  expect_fault("\"distance\"", "\"depth\"", "claim: found \"depth\"");
  expect_fault("\"separated\"", "\"touching\"", "answer: found \"touching\"");
  expect_fault("[0.1,0.3]", "[0.1]", "bounds: found an array of 1");
  expect_fault(":7", ":-7", "undecided: found -7");
  expect_fault("\"order_a\":[0]", "\"order_a\":[-1]", "order_a[0]: found -1");
  expect_fault("\"own\"", "\"mine\"", "cover[3]: found \"mine\"");
  expect_fault("\"-2\"", "\"-0.5\"", "cover[2][1]: found \"-0.5\"");
  expect_fault("\"own\"", "3", "cover[3]: found 3");
  expect_fault("[0,1],", "[0],", "met[0].parts: found an array of 1");
  expect_fault("\"body\":\"b\"", "\"body\":\"c\"", "inside.body: found \"c\"");
  expect_fault("\"part\":2", "\"part\":-2", "inside.part: found -2");
  expect_fault("[[0,1,2]],\"solid\"", "[[0,1,3]],\"solid\"", "a.shape.triangles[0][2]: found 3");
}

}  // namespace
}  // namespace touchstone
