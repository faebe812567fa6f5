// Tests of rows: writing, reading, errors, documentation.
#include "harness/record/row.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

enum class Fruit : std::uint8_t { apple, pear, plum };
std::string_view to_string(Fruit fruit) {
  constexpr std::array<std::string_view, 3> names = {"apple", "pear", "plum"};
  return names[static_cast<std::size_t>(fruit)];
}

struct Basket {
  std::string owner;
  std::int64_t number = -1;
  std::uint32_t small = 0;
  double weight = std::nan("");
  bool sold = false;
  Fruit fruit = Fruit::apple;
  std::optional<Fruit> other;
  std::optional<int> shelf;
  std::array<std::int64_t, 3> counts{};  // one for each fruit
  double estimate = std::nan("");
  std::int64_t balance = 0;
  std::array<char, 8> code{};
  std::string note = "none";
};

template <record::row_of<Basket> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("owner", row.owner, "The basket's owner.");
  visit("number", row.number, "Its place in the list.");
  visit("small", row.small, "A count.");
  visit("weight", row.weight, "Kilograms.");
  visit("sold", row.sold, "True once it is sold.");
  visit("fruit", row.fruit, "What is in it.");
  visit("other", row.other, "What else is in it.");
  visit("shelf", row.shelf, "Where it stands.");
  for (const Fruit fruit : base::enumerators<Fruit>) {
    visit(to_string(fruit), row.counts[static_cast<std::size_t>(fruit)], "A count of one fruit.");
  }
  visit("estimate", record::rounded(row.estimate, 3), "Roughly.");
  visit("balance", record::with_sign(row.balance), "Cents.");
  visit("code", row.code, "A short text.");
  visit("note", record::newer(row.note), "A remark.");
}

constexpr const char* header =
    "owner,number,small,weight,sold,fruit,other,shelf,apple,pear,plum,estimate,balance,code,note\n";

Basket full_basket() {
  Basket basket;
  basket.owner = "a, b";
  basket.number = 7;
  basket.small = 3;
  basket.weight = 0.1;
  basket.sold = true;
  basket.fruit = Fruit::plum;
  basket.other = Fruit::pear;
  basket.shelf = 2;
  basket.counts = {1, 2, 3};
  basket.estimate = 1234.5678;
  basket.balance = -5;
  basket.code = {'x', 'y'};
  basket.note = "fine";
  return basket;
}

class RowFileTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::vector<Basket>& baskets) const {
    files::CsvWriter file(folder_.path() / "b.csv", record::header_of<Basket>());
    for (const Basket& basket : baskets) record::write_row(file, basket);
    file.close();
    return folder_.path() / "b.csv";
  }
  std::string fault(const std::string& line) const {
    folder_.write("f.csv", header + line + "\n");
    return folder_.without_path(
        input_fault([&] { record::read_rows<Basket>(folder_.path() / "f.csv"); }));
  }
  TemporaryFolder folder_;
};

TEST_F(RowFileTest, FieldsAreWrittenInTheirOrder) {
  write({full_basket(), {}});
  EXPECT_EQ(folder_.read("b.csv"),
            std::string(header) + "\"a, b\",7,3,0.1,1,plum,pear,2,1,2,3,1.23e+03,-5,xy,fine\n" +
                ",,0,,0,apple,,,0,0,0,,0,,none\n");
}

TEST_F(RowFileTest, WhatWasWrittenIsReadBack) {
  const std::vector<Basket> rows = record::read_rows<Basket>(write({full_basket(), {}}));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].owner, "a, b");
  EXPECT_EQ(rows[0].weight, 0.1);
  EXPECT_TRUE(rows[0].sold);
  EXPECT_EQ(rows[0].fruit, Fruit::plum);
  EXPECT_EQ(rows[0].other, Fruit::pear);
  EXPECT_EQ(rows[0].shelf, 2);
  EXPECT_THAT(rows[0].counts, ElementsAre(1, 2, 3));
  EXPECT_EQ(rows[0].estimate, 1230);
  EXPECT_EQ(rows[0].balance, -5);
  EXPECT_STREQ(rows[0].code.data(), "xy");
  EXPECT_EQ(rows[1].number, -1);
  EXPECT_TRUE(std::isnan(rows[1].weight));
  EXPECT_FALSE(rows[1].other);
  EXPECT_FALSE(rows[1].shelf);
}

TEST_F(RowFileTest, AFaultNamesFileLineColumnFoundAndExpected) {
  EXPECT_EQ(fault("a,,x,,0,apple,,,0,0,0,,0,,"),
            "f.csv:2: column small: found 'x'; expected an integer");
  EXPECT_EQ(fault("a,,-1,,0,apple,,,0,0,0,,0,,"),
            "f.csv:2: column small: found '-1'; expected a whole number from 0 to 4294967295");
  EXPECT_EQ(fault("a,,0,,yes,apple,,,0,0,0,,0,,"),
            "f.csv:2: column sold: found 'yes'; expected 0 or 1");
  EXPECT_EQ(fault("a,,0,,0,fig,,,0,0,0,,0,,"),
            "f.csv:2: column fruit: found 'fig'; expected one of apple, pear, plum");
  EXPECT_EQ(fault("a,,0,,0,apple,,,0,0,0,,0,too long,"),
            "f.csv:2: column code: found 'too long'; expected less than 8 characters");
}

TEST_F(RowFileTest, ANewerColumnMayBeAbsent) {
  std::string old = header;
  old.replace(old.find(",note"), 5, "");
  const auto file = folder_.write("old.csv", old + "a,,0,,0,apple,,,0,0,0,,0,\n");
  EXPECT_EQ(record::read_rows<Basket>(file).at(0).note, "none");
  std::string older = old;
  older.replace(older.find(",code"), 5, "");
  folder_.write("older.csv", older + "a,,0,,0,apple,,,0,0,0,,0\n");
  EXPECT_THAT(input_fault([&] { record::read_rows<Basket>(folder_.path() / "older.csv"); }),
              HasSubstr("older.csv:1: no column 'code'"));
}

TEST(Row, ItsColumnsAreDocumented) {
  const std::string docs = record::column_docs<Basket>();
  EXPECT_THAT(docs, HasSubstr("| `weight` | number | Kilograms. |\n"));
  EXPECT_THAT(docs, HasSubstr("| `other` | apple, pear, plum, or empty | What else is in it. |\n"));
  EXPECT_THAT(docs, HasSubstr("| `plum` | whole number | A count of one fruit. |\n"));
}

// A row of a request, whose fields are indices into the request's lists.
struct Owners {
  std::vector<std::string> names, towns;
};
struct Sale {
  std::uint32_t owner = 0;
  double price = 0;
  std::int64_t pieces = 0;
};
template <record::row_of<Sale> Row, class Visit>
void columns(Row& row, Visit visit, const Owners& owners) {
  const auto name = [&](std::size_t i) { return owners.names[i]; };
  visit("owner", record::place_in(row.owner, owners.names.size(), name), "The seller.");
  visit("town", record::derived([&] { return owners.towns[row.owner]; }), "The seller's town.");
  visit("price", row.price, "Euros.");
  visit("pieces", record::nonzero(row.pieces), "How many; empty: one.");
  visit("half", record::derived([&] { return row.price / 2; }), "Euros.");
}

TEST_F(RowFileTest, PlacesInListsAreWrittenAsNames) {
  const Owners owners{{"Ann", "Bob"}, {"Ulm", "Bonn"}};
  const auto path = folder_.path() / "s.csv";
  files::CsvWriter file(path, record::header_of<Sale>(owners));
  record::write_row(file, Sale{1, 2.5}, owners);
  record::write_row(file, Sale{0, 3, 7}, owners);
  file.close();
  EXPECT_EQ(folder_.read("s.csv"),
            "owner,town,price,pieces,half\nBob,Bonn,2.5,,1.25\nAnn,Ulm,3,7,1.5\n");
  const std::vector<Sale> rows = record::read_rows<Sale>(path, owners);
  EXPECT_EQ(rows.at(0).owner, 1u);
  EXPECT_EQ(rows.at(0).pieces, 0);
  EXPECT_EQ(rows.at(1).pieces, 7);
  record::write_rows(folder_.path() / "t.csv", rows, owners);
  EXPECT_EQ(folder_.read("t.csv"), folder_.read("s.csv"));
  const Owners others{{"Ann"}, {"Ulm"}};
  EXPECT_EQ(folder_.without_path(input_fault([&] { record::read_rows<Sale>(path, others); })),
            "s.csv:2: column owner: found 'Bob'; expected one of the names of this request");
  EXPECT_THAT(record::column_docs<Sale>(Owners{}), HasSubstr("| `owner` | name | The seller. |\n"));
  EXPECT_THAT(record::column_docs<Sale>(Owners{}), HasSubstr("| `half` | number | Euros. |\n"));
}

}  // namespace
}  // namespace touchstone
