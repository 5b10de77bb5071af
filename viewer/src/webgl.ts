import { find } from "./element";

const EXPLANATION = `This browser cannot draw in three dimensions: WebGL 2 is missing or switched off.

- Switch on hardware acceleration in the settings of the browser, or open this address in another one.
- The program draws without a browser: C.viewer().savePng("scene.png") saves a picture; saveFilm makes films.`;

/** Explains on the page if the browser cannot draw, and ends the script. */
export function requireWebGL(): void {
  if (document.createElement("canvas").getContext("webgl2")) return;
  find("canvas").hidden = true;
  for (const button of document.querySelectorAll<HTMLElement>("body > button")) button.hidden = true;
  Object.assign(find("error"), { textContent: EXPLANATION, hidden: false });
  throw new Error("WebGL 2 is not available");
}
