// Bundles the page into one file: scripts and styles inside, no address outside.
// Usage: node build.js OUT.html
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";

const out = process.argv[2];
if (!out) throw new Error("usage: node build.js OUT.html");
const bundled = await build({
  entryPoints: ["src/main.ts", "src/page.css"],
  bundle: true,
  minify: true,
  write: false,
  outdir: ".",
  target: ["chrome123", "firefox128"],
  legalComments: "inline",
});
const text = (end) => bundled.outputFiles.find((file) => file.path.endsWith(end)).text;
const page = await readFile("src/page.html", "utf8");
// A script must not contain the tag that ends it.
const script = text(".js").replaceAll("</script", "<\\/script");
// The page runs this script and no other.
const hash = createHash("sha256").update(script).digest("base64");
await writeFile(
  out,
  page
    .replace("SCRIPT_HASH", `sha256-${hash}`)
    .replace("/*STYLE*/", () => text(".css"))
    .replace("/*SCRIPT*/", () => script),
);
