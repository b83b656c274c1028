/** Shapes of handles, along and about the z axis of their group: thin to see, broad to pick. */

import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SphereGeometry,
  TorusGeometry,
  type BufferGeometry,
} from "three";

/** Sizes as shares of an arrow's length. */
const LINE = 0.011;
const HEAD = { radius: 0.05, length: 0.14 };
const GRASP = 0.08;
const SQUARE = { from: 0.3, size: 0.2 };
const RING = 0.85;
const DOT = 0.04;

export type HandleKind = "axis" | "plane" | "ring" | "free";

/** Handle: its visible shape, and its broader pick shape. */
export class HandleShape extends Group {
  private readonly material = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true });
  private readonly unseen = new MeshBasicMaterial({ visible: false });

  constructor(readonly kind: HandleKind) {
    super();
    switch (kind) {
      case "axis":
        this.addShape(
          new CylinderGeometry(LINE, LINE, 1 - HEAD.length).rotateX(Math.PI / 2).translate(0, 0, (1 - HEAD.length) / 2),
        );
        this.addShape(
          new ConeGeometry(HEAD.radius, HEAD.length, 24).rotateX(Math.PI / 2).translate(0, 0, 1 - HEAD.length / 2),
        );
        this.addPickShape(new CylinderGeometry(GRASP, GRASP, 0.85).rotateX(Math.PI / 2).translate(0, 0, 0.6));
        break;
      case "plane":
        this.addShape(
          new PlaneGeometry(SQUARE.size, SQUARE.size).translate(
            SQUARE.from + SQUARE.size / 2,
            SQUARE.from + SQUARE.size / 2,
            0,
          ),
        );
        this.addPickShape(
          new PlaneGeometry(SQUARE.size, SQUARE.size).translate(
            SQUARE.from + SQUARE.size / 2,
            SQUARE.from + SQUARE.size / 2,
            0,
          ),
        );
        this.unseen.side = this.material.side = 2;
        break;
      case "ring":
        this.addShape(new TorusGeometry(RING, LINE, 8, 96));
        this.addPickShape(new TorusGeometry(RING, GRASP, 8, 48));
        break;
      case "free":
        this.addShape(new SphereGeometry(DOT, 16, 12));
        this.addPickShape(new SphereGeometry(2 * DOT, 12, 8));
    }
  }

  paint(color: string, opacity: number): void {
    this.material.color.set(color);
    this.material.opacity = opacity;
  }

  private addShape(geometry: BufferGeometry): void {
    const mesh = new Mesh(geometry, this.material);
    mesh.renderOrder = this.kind === "free" ? 1002 : 1001;
    mesh.frustumCulled = false;
    this.add(mesh);
  }

  private addPickShape(geometry: BufferGeometry): void {
    this.add(new Mesh(geometry, this.unseen));
  }
}
