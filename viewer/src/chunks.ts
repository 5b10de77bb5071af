import { ShaderChunk } from "three";

const SAMPLES = 5; // of the shadow map per pixel
const GOLDEN_ANGLE = 2.399963229728653; // rad, between the samples

/** Replaces a part of a shader of three.js. */
export function replaceIn(chunk: keyof typeof ShaderChunk, part: string | RegExp, by: string): void {
  const replaced = ShaderChunk[chunk].replace(part, () => by);
  if (replaced === ShaderChunk[chunk]) throw new Error(`nothing to replace in the shader ${chunk}`);
  ShaderChunk[chunk] = replaced;
}

/** Soft shadows: each pixel samples five places in a disk with a different rotation. The sequence of places is
 * three.js's own. For a disk without radius, one sample is enough, which is much faster in software. */
export function checkHardShadowsOnce(): void {
  const places = Array.from({ length: SAMPLES }, (_, i) => {
    const radius = Math.sqrt((i + 0.5) / SAMPLES);
    return `vec2(${[Math.cos(i * GOLDEN_ANGLE), Math.sin(i * GOLDEN_ANGLE)].map((x) => (radius * x).toFixed(9)).join(", ")})`;
  });
  replaceIn(
    "shadowmap_pars_fragment",
    /shadow = \(\s*texture\( shadowMap, vec3\( shadowCoord\.xy \+ vogelDiskSample\([^;]*;/,
    /* glsl */ `vec2 places[${SAMPLES}] = vec2[](${places.join(", ")});
    mat2 turn = mat2(cos(phi) * radius.x, sin(phi) * radius.y, -sin(phi) * radius.x, cos(phi) * radius.y);
    int samples = shadowRadius > 0.0 ? ${SAMPLES} : 1;
    shadow = 0.0;
    for (int i = 0; i < samples; ++i) shadow += texture(shadowMap, vec3(shadowCoord.xy + turn * places[i], shadowCoord.z));
    shadow /= float(samples);`,
  );
}
