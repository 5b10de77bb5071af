import * as THREE from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

const WIDTH = 2; // pixels

/** Line segments of a width in pixels, between consecutive pairs of points, in the colors of their ends or in one
color.
 * */
export class WideLines extends LineSegments2 {
  /** `points`: positions, and colors if they have own ones. */
  constructor(points: THREE.BufferGeometry, color: THREE.Color, opacity: number, width = WIDTH) {
    const position = points.getAttribute("position"), own = points.getAttribute("color");
    const geometry = new LineSegmentsGeometry().setPositions(position.array as Float32Array);
    if (own) geometry.setColors(own.array as Float32Array);
    super(
      geometry,
      new LineMaterial({
        color: own ? 0xffffff : color,
        vertexColors: own !== undefined,
        linewidth: width,
        opacity,
        transparent: opacity < 1,
        fog: true,
      }),
    );
  }

  /** Clicks pass through lines. */
  override raycast(): void {}

  /** Returns the same lines as plain segments, one pixel wide, for files of models. */
  plain(): THREE.LineSegments {
    const { instanceStart, instanceColorStart } = this.geometry.attributes;
    const geometry = new THREE.BufferGeometry();
    const array = (attribute: THREE.BufferAttribute | THREE.InterleavedBufferAttribute): Float32Array =>
      (attribute as THREE.InterleavedBufferAttribute).data.array as Float32Array;
    geometry.setAttribute("position", new THREE.BufferAttribute(array(instanceStart!), 3));
    if (instanceColorStart) geometry.setAttribute("color", new THREE.BufferAttribute(array(instanceColorStart), 3));
    const { color, vertexColors } = this.material;
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color, vertexColors }));
  }
}
