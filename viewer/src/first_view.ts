import * as THREE from "three";

/** Directions towards the camera: from the front left of a robot that faces x, then from the other sides. */
const DIRECTIONS: [number, number, number][] = [[1.5, 2.6, 0.9], [2.6, -1.5, 0.9], [-2.6, 1.5, 0.9], [-1.5, -2.6, 0.9]];
const BETTER = 1.5; // another direction is taken if it shows more by this factor
const MOST = 200; // shapes that are considered

interface Block {
  matrix: THREE.Matrix4; // from the world to the shape's own axes
  box: THREE.Box3; // in its own axes
  corners: THREE.Vector3[]; // center and centers of faces, world
}

function blockOf(mesh: THREE.Mesh): Block {
  const { geometry } = mesh;
  if (!geometry.boundingBox) geometry.computeBoundingBox();
  const box = geometry.boundingBox!;
  const center = box.getCenter(new THREE.Vector3()), half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
  const offsets = [[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]] as const;
  const corners = offsets.map(([x, y, z]) =>
    new THREE.Vector3(x, y, z).multiply(half).add(center).applyMatrix4(mesh.matrixWorld));
  return { matrix: mesh.matrixWorld.clone().invert(), box, corners };
}

/** Returns the corners of the boxes around the shapes, in the world. */
export function cornersOf(objects: (THREE.Mesh | THREE.Points)[]): THREE.Vector3[] {
  const corners: THREE.Vector3[] = [];
  for (const { geometry, matrixWorld } of objects) {
    if (!geometry.boundingBox) geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox!;
    if (min.x > max.x) continue; // no points
    for (const x of [min.x, max.x])
      for (const y of [min.y, max.y])
        for (const z of [min.z, max.z]) corners.push(new THREE.Vector3(x, y, z).applyMatrix4(matrixWorld));
  }
  return corners;
}

/** Counts the points of the blocks that no other block hides from a direction. */
function visibleFrom(direction: THREE.Vector3, blocks: Block[]): number {
  const ray = new THREE.Ray(), at = new THREE.Vector3();
  let visible = 0;
  for (const block of blocks)
    for (const corner of block.corners)
      visible += Number(
        !blocks.some((other) => {
          if (other === block) return false;
          ray.origin.copy(corner);
          ray.direction.copy(direction);
          ray.applyMatrix4(other.matrix);
          return !other.box.containsPoint(ray.origin) && ray.intersectBox(other.box, at) !== null;
        }),
      );
  return visible;
}

/** Returns the direction towards the camera that shows most of the shapes: a shelf is seen from its open side. */
export function firstDirection(meshes: THREE.Mesh[]): THREE.Vector3 {
  const every = Math.max(1, Math.ceil(meshes.length / MOST));
  const blocks = meshes.filter((_, i) => i % every === 0).map(blockOf);
  let best = new THREE.Vector3(...DIRECTIONS[0]!), most = 0;
  for (const [i, xyz] of DIRECTIONS.entries()) {
    const direction = new THREE.Vector3(...xyz).normalize();
    const visible = visibleFrom(direction, blocks);
    if (i > 0 && visible <= BETTER * most) continue;
    best = direction;
    most = visible;
  }
  return best;
}
