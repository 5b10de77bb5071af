// Bundles the client into one HTML page with nothing to load: dist/index.html.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
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
// Small pages in notebooks have the script packed, and this one in its place.
const unpack = readFileSync("src/unpack.js", "utf8").trim();
const allowed = [script, unpack].map((text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`).join(" ");
// The page loads nothing, runs no other script than its own, and talks to its own server only.
const policy = [
  "default-src 'none'", `script-src ${allowed}`,
  "style-src 'unsafe-inline'", "img-src data: blob:", "media-src blob: data:", "connect-src 'self' data: blob:", "base-uri 'none'",
  "form-action 'none'",
].join("; ");
const page = readFileSync("src/index.html", "utf8")
  .replace("<!-- POLICY -->", () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
  .replace("/* STYLE */", () => readFileSync("src/style.css", "utf8"))
  .replace("/* UNPACK */", () => unpack)
  .replace("/* SCRIPT */", () => script);
writeFileSync("dist/index.html", page);
console.log(`dist/index.html: ${Math.round(page.length / 1000)} kB`);
