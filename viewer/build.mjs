// Bundles the client into one HTML page with nothing to load: dist/index.html.
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";

mkdirSync("dist", { recursive: true });
const bundle = spawnSync("node_modules/.bin/esbuild",
  ["src/main.ts", "--bundle", "--minify", "--format=iife", "--target=es2022", "--legal-comments=eof"],
  { encoding: "utf8", maxBuffer: 1 << 26 });
if (bundle.status !== 0) {
  console.error(bundle.error ?? bundle.stderr);
  process.exit(1);
}
const script = bundle.stdout.replaceAll("</script", "<\\/script");
const page = readFileSync("src/index.html", "utf8")
  .replace("/* STYLE */", () => readFileSync("src/style.css", "utf8"))
  .replace("/* SCRIPT */", () => script);
writeFileSync("dist/index.html", page);
console.log(`dist/index.html: ${Math.round(page.length / 1000)} kB`);
