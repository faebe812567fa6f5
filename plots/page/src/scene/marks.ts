// Points, lines, arrows and surfaces stand for a body, an answer or a proof.
import * as THREE from "three";
import type { Magnifier } from "./magnifier";
import type { Surface } from "./surfaces";

export const colours = { a: 0x3f7fbf, b: 0xd98032, proof: 0x2e9e5b, answer: 0xb3261e };

export function solid(surface: Surface, magnifier: Magnifier, colour: number): THREE.Object3D[] {
  const material = new THREE.MeshStandardMaterial({
    color: colour,
    transparent: true,
    opacity: 0.7,
    side: THREE.DoubleSide,
    flatShading: true,
    roughness: 0.8,
  });
  return [
    new THREE.Mesh(magnifier.triangles(surface), material),
    new THREE.LineSegments(
      magnifier.segments(surface),
      new THREE.LineBasicMaterial({ color: colour }),
    ),
  ];
}

// A veil is a part of a proof, through which the bodies can be seen. If it lies within them, it is drawn over them.
export function veil(surface: Surface, magnifier: Magnifier, within: boolean): THREE.Object3D[] {
  const material = new THREE.MeshBasicMaterial({
    color: colours.proof,
    transparent: true,
    opacity: 0.25,
    side: THREE.DoubleSide,
    depthWrite: false,
    depthTest: !within,
  });
  const mesh = new THREE.Mesh(magnifier.triangles(surface), material);
  mesh.renderOrder = within ? 1 : 0;
  return [
    mesh,
    new THREE.LineSegments(
      magnifier.segments(surface),
      new THREE.LineBasicMaterial({ color: colours.proof }),
    ),
  ];
}

// Marks are seen through the bodies. An opaque mark would be drawn before them, and be covered.
function on_top<Any extends THREE.Material>(material: Any): Any {
  material.depthTest = false;
  material.transparent = true;
  return material;
}

export function dot_at(place: THREE.Vector3, colour: number, form: "ball" | "cube"): THREE.Mesh {
  const geometry =
    form === "ball"
      ? new THREE.SphereGeometry(0.025, 16, 12)
      : new THREE.BoxGeometry(0.04, 0.04, 0.04);
  const mesh = new THREE.Mesh(geometry, on_top(new THREE.MeshBasicMaterial({ color: colour })));
  mesh.position.copy(place);
  mesh.renderOrder = 2;
  return mesh;
}

export function line(points: THREE.Vector3[], colour: number, dashed: boolean): THREE.Line {
  const material = dashed
    ? new THREE.LineDashedMaterial({ color: colour, dashSize: 0.03, gapSize: 0.02 })
    : new THREE.LineBasicMaterial({ color: colour });
  const object = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), on_top(material));
  if (dashed) object.computeLineDistances();
  object.renderOrder = 1;
  return object;
}

export function arrow(
  from: THREE.Vector3,
  direction: THREE.Vector3,
  length: number,
  colour: number,
): THREE.ArrowHelper {
  const head = Math.min(0.12, length / 2);
  const made = new THREE.ArrowHelper(
    direction.clone().normalize(),
    from,
    length,
    colour,
    head,
    head / 2,
  );
  for (const piece of [made.line, made.cone]) {
    piece.renderOrder = 1;
    [piece.material].flat().forEach(on_top);
  }
  return made;
}
