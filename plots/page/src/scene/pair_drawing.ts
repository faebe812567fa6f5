// The drawing shows a pair of bodies, the proof of what is so, and what an algorithm says.
import type * as THREE from "three";
import { Vector3 } from "three";
import type { AnswerView, BodyView, CaseView, Triple } from "../bundle";
import { Magnifier } from "./magnifier";
import { arrow, colours, dot_at, line, solid, veil } from "./marks";
import { even, magnified, surface_of } from "./surfaces";
import { add, beside, dot, norm, placed, subtract, times, unit } from "./vectors";

const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1];

// It knows where the bodies are closest or deepest, in which direction, and how large they are.
export class PairDrawing {
  readonly normal: Triple;
  readonly gap: number; // or the depth, metres
  readonly size: number;
  private readonly contact: Triple;

  constructor(private readonly pair: CaseView) {
    const { a, b, truth, proof } = pair;
    this.normal = unit(truth.normal ?? subtract(b.translation, a.translation));
    this.gap = Math.abs(((truth.lower ?? NaN) + (truth.upper ?? NaN)) / 2) || 0;
    const middle = (p: Triple, q: Triple): Triple => add(p, times(0.5, subtract(q, p)));
    this.contact =
      proof.point ??
      (proof.on_a && proof.on_b
        ? middle(proof.on_a, proof.on_b)
        : middle(a.translation, b.translation));
    this.size = Math.max(this.extent(a), this.extent(b)) || 1;
  }

  // The extent is how far the body reaches from its origin, metres. A half-space has no end: it counts for nothing.
  private extent(body: BodyView): number {
    if (body.shape.type === "halfspace") return 0;
    const origin = placed(body, [0, 0, 0]);
    const { points } = surface_of(body, this.normal, this.contact, 1, even(8, 12));
    return points.reduce((most, point) => Math.max(most, norm(subtract(point, origin))), 0);
  }

  // These are points on both bodies where nothing is enlarged. Half-spaces have none, since they have no end.
  corners(): Vector3[] {
    const magnifier = new Magnifier(this.contact, this.normal, this.size, 1, 1);
    return [this.pair.a, this.pair.b]
      .filter(({ shape }) => shape.type !== "halfspace")
      .flatMap((body) => surface_of(body, this.normal, this.contact, 1, even(8, 12)).points)
      .map((point) => magnifier.place(point));
  }

  // With these powers of ten the gap is as wide as a fifth of a body's size. One half of them enlarges all, so that
  // the bodies are as curved as the gap is wide. The other half stretches along the normal.
  powers_for_gap(): [number, number] {
    if (!(this.gap > 0)) return [0, 0];
    const power = Math.log10((0.2 * this.size) / this.gap);
    return power > 0 ? [Math.min(7, power / 2), Math.min(8, power / 2)] : [0, 0];
  }

  objects(chosen: AnswerView[], zoom_power: number, stretch_power: number): THREE.Object3D[] {
    const { pair, contact, normal, size } = this;
    const magnifier = new Magnifier(contact, normal, size, 10 ** zoom_power, 10 ** stretch_power);
    const surface = (body: BodyView, pole: Triple): THREE.Object3D[] => {
      const colour = body === pair.a ? colours.a : colours.b;
      return solid(surface_of(body, pole, contact, 3 * size, magnified()), magnifier, colour);
    };
    return [
      ...surface(pair.a, normal),
      ...surface(pair.b, times(-1, normal)),
      ...this.proof(magnifier),
      ...chosen.flatMap((answer) => this.answer(magnifier, answer)),
    ];
  }

  private proof(magnifier: Magnifier): THREE.Object3D[] {
    const { plane, point, on_a, on_b, ball } = this.pair.proof;
    const objects: THREE.Object3D[] = [];
    if (plane) {
      const middle = add(
        this.contact,
        times(plane.offset - dot(plane.normal, this.contact), plane.normal),
      );
      objects.push(...veil(square(middle, plane.normal, 1.5 * this.size), magnifier, false));
    }
    if (point) objects.push(dot_at(magnifier.place(point), colours.proof, "ball"));
    if (on_a && on_b) {
      const from = magnifier.place(on_b),
        to = magnifier.place(on_a);
      objects.push(line([from, to], colours.proof, false));
      for (const end of [from, to]) objects.push(dot_at(end, colours.proof, "ball"));
      const way = to.clone().sub(from);
      if (ball && way.length() > 0) {
        objects.push(arrow(from, way, way.length(), colours.proof));
        const round: BodyView = {
          shape: { type: "sphere", radius: ball.radius },
          matrix: identity,
          translation: ball.centre,
        };
        objects.push(
          ...veil(surface_of(round, this.normal, this.contact, 1, even(23, 32)), magnifier, true),
        );
      }
    }
    return objects;
  }

  private answer(
    magnifier: Magnifier,
    { witness_a, witness_b, normal }: AnswerView,
  ): THREE.Object3D[] {
    const points = [witness_a, witness_b]
      .filter((each) => each !== null)
      .map((each) => magnifier.place(each));
    const objects: THREE.Object3D[] = points.map((place) => dot_at(place, colours.answer, "cube"));
    if (points.length === 2) objects.push(line(points, colours.answer, true));
    if (normal) {
      objects.push(
        arrow(
          points[0] ?? magnifier.place(this.contact),
          new Vector3(...normal),
          0.5,
          colours.answer,
        ),
      );
    }
    return objects;
  }
}

function square(middle: Triple, normal: Triple, half: number): ReturnType<typeof surface_of> {
  const [u, v] = beside(normal);
  const corner = (x: number, y: number): Triple =>
    add(middle, add(times(x * half, u), times(y * half, v)));
  return {
    points: [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)],
    triangles: [
      [0, 1, 2],
      [0, 2, 3],
    ],
    edges: [
      [0, 1],
      [1, 2],
      [2, 3],
      [3, 0],
    ],
  };
}
