/** Covariance of a pose as rviz draws it: an ellipsoid of its position, and discs or a triangle of its orientation. */

import { BufferAttribute, BufferGeometry, DoubleSide, Group, Matrix4, Mesh, Quaternion, Vector3 } from "three";

import { BoolProperty, ColorProperty, EnumProperty, NumberProperty, type Rgb } from "../rviz/properties";
import { AXIS_RGB } from "./axes";
import { principalAxes } from "./eigen";
import { ShapeMaterial } from "./shape_material";
import { CYLINDER, SPHERE } from "./solids";

/** rviz's properties below `Covariance`. */
export class CovarianceProperty extends BoolProperty {
  readonly position = this.add(new BoolProperty("Position", true));
  readonly positionColor = this.position.add(new ColorProperty("Color", [204, 51, 204]));
  readonly positionAlpha = this.position.add(new NumberProperty("Alpha", 0.3, { min: 0, max: 1 }));
  readonly positionScale = this.position.add(new NumberProperty("Scale", 1, { min: 0 }));
  readonly orientation = this.add(new BoolProperty("Orientation", true));
  readonly frame = this.orientation.add(new EnumProperty("Frame", "Local", ["Local", "Fixed"]));
  readonly colorStyle = this.orientation.add(new EnumProperty("Color Style", "Unique", ["Unique", "RGB"]));
  readonly orientationColor = this.orientation.add(new ColorProperty("Color", [255, 255, 127]));
  readonly orientationAlpha = this.orientation.add(new NumberProperty("Alpha", 0.5, { min: 0, max: 1 }));
  readonly offset = this.orientation.add(new NumberProperty("Offset", 1, { min: 0, unit: "m" }));
  readonly orientationScale = this.orientation.add(new NumberProperty("Scale", 1, { min: 0 }));

  constructor() {
    super("Covariance", true);
  }
}

/** Thickness of flat shapes [m], and the widest drawn angle [rad]. */
const FLAT = 0.001;
const WIDEST = (89 * Math.PI) / 180;
/**
 * Per disc: rows of the two rotations whose variances spread it, and the rotation whose x and y are the directions of
 *
 * A rotation about y moves the roll disc, whose normal is x, along z; a rotation about z moves it along -y (up to
 * sign).
 */
const DISCS = [
  { rows: [4, 5], turn: basis(new Vector3(0, 0, 1), new Vector3(0, -1, 0)) },
  { rows: [3, 5], turn: basis(new Vector3(0, 0, -1), new Vector3(1, 0, 0)) },
  { rows: [3, 4], turn: basis(new Vector3(1, 0, 0), new Vector3(0, -1, 0)) },
] as const;

function basis(x: Vector3, y: Vector3): Quaternion {
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(x, y, x.clone().cross(y)));
}

/**
 * Shapes of a covariance, to be placed at the pose's position with the axes of the message's frame.
 *
 * A pose whose variances of z, roll and pitch are not positive is planar, as rviz has it.
 */
export class CovarianceVisual extends Group {
  private readonly ellipsoid = new Mesh(SPHERE, new ShapeMaterial());
  private readonly turn = new Group();
  private readonly discs = AXIS_RGB.map(() => new Mesh(CYLINDER, new ShapeMaterial()));
  private readonly triangle = new Mesh(triangle(), new ShapeMaterial({ side: DoubleSide }));
  private covariance: ArrayLike<number> = [];
  private readonly poseOrientation = new Quaternion();

  constructor(private readonly property: CovarianceProperty) {
    super();
    this.turn.add(...this.discs, this.triangle);
    super.add(this.ellipsoid, this.turn);
  }

  /** 6 × 6 covariance row by row [m², rad²], and the pose's orientation in its frame. */
  setCovariance(covariance: ArrayLike<number>, orientation: Quaternion): void {
    this.covariance = covariance;
    this.poseOrientation.copy(orientation);
    this.refresh();
  }

  /** Draw again with the current properties. */
  refresh(): void {
    const { property } = this;
    const entry = (row: number, column: number): number => this.covariance[6 * row + column] ?? 0;
    const planar = entry(2, 2) <= 0 && entry(3, 3) <= 0 && entry(4, 4) <= 0;
    this.visible = property.value.value;
    this.ellipsoid.visible = property.position.value.value;
    this.turn.visible = property.orientation.value.value;
    if (property.frame.value.value === "Local") this.turn.quaternion.copy(this.poseOrientation);
    else this.turn.quaternion.identity();
    this.drawPosition(entry, planar);
    this.drawOrientation(entry, planar);
  }

  private drawPosition(entry: (row: number, column: number) => number, planar: boolean): void {
    const { property } = this;
    const [xz, yz, zz] = planar ? [0, 0, 0] : [entry(0, 2), entry(1, 2), entry(2, 2)];
    const { values, rotation } = principalAxes([
      entry(0, 0),
      entry(0, 1),
      xz,
      entry(1, 0),
      entry(1, 1),
      yz,
      xz,
      yz,
      zz,
    ]);
    const scale = 2 * property.positionScale.value.value;
    const size = (variance: number): number => Math.max(FLAT, scale * Math.sqrt(variance));
    this.ellipsoid.quaternion.copy(rotation);
    this.ellipsoid.scale.set(size(values[0]), size(values[1]), size(values[2]));
    this.ellipsoid.material.setColor(property.positionColor.value.value, property.positionAlpha.value.value);
  }

  private drawOrientation(entry: (row: number, column: number) => number, planar: boolean): void {
    const { property } = this;
    const offset = property.offset.value.value;
    const width = (variance: number): number =>
      2 * offset * Math.tan(Math.min(WIDEST, property.orientationScale.value.value * Math.sqrt(variance)));
    const color = (axis: number): Rgb => {
      const axisColor = AXIS_RGB[axis] ?? [255, 255, 255];
      return property.colorStyle.value.value === "RGB" ? axisColor : property.orientationColor.value.value;
    };
    const alpha = property.orientationAlpha.value.value;
    this.triangle.visible = planar;
    this.triangle.scale.set(offset, width(Math.max(0, entry(5, 5))), 1);
    this.triangle.material.setColor(color(2), alpha);
    this.discs.forEach((disc, axis) => {
      disc.visible = !planar;
      const {
        rows: [first, second],
        turn,
      } = DISCS[axis] ?? DISCS[2];
      const { angle, major, minor } = planeAxes(entry(first, first), entry(first, second), entry(second, second));
      disc.position.set(0, 0, 0).setComponent(axis, offset);
      disc.quaternion.setFromAxisAngle(Z, angle).premultiply(turn);
      disc.scale.set(Math.max(FLAT, width(major)), Math.max(FLAT, width(minor)), FLAT);
      disc.material.setColor(color(axis), alpha);
    });
  }

  override dispose(): void {
    this.ellipsoid.material.dispose();
    this.triangle.geometry.dispose();
    this.triangle.material.dispose();
    for (const disc of this.discs) disc.material.dispose();
  }
}

const Z = new Vector3(0, 0, 1);

/** Principal axes of the symmetric matrix (a b; b c): angle of the major one and both variances. */
function planeAxes(a: number, b: number, c: number): { angle: number; major: number; minor: number } {
  const mean = (a + c) / 2;
  const radius = Math.hypot((a - c) / 2, b);
  return {
    angle: 0.5 * Math.atan2(2 * b, a - c),
    major: Math.max(0, mean + radius),
    minor: Math.max(0, mean - radius),
  };
}

/** Flat triangle from its tip at the origin to a base of 1 m at x = 1. */
function triangle(): BufferGeometry {
  const points = new Float32Array([0, 0, 0, 1, -0.5, 0, 1, 0.5, 0]);
  const normals = new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]);
  const uv = new Float32Array(6);
  return new BufferGeometry()
    .setAttribute("position", new BufferAttribute(points, 3))
    .setAttribute("normal", new BufferAttribute(normals, 3))
    .setAttribute("uv", new BufferAttribute(uv, 2));
}
