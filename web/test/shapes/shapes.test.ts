import { Box3, Matrix4, Quaternion, Raycaster, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { Arrow } from "../../src/shapes/arrow";
import { Axes } from "../../src/shapes/axes";
import { BillboardLines } from "../../src/shapes/billboard_lines";
import { CovarianceProperty, CovarianceVisual } from "../../src/shapes/covariance";
import { principalAxes } from "../../src/shapes/eigen";
import { Instances } from "../../src/shapes/instances";
import { arrowGeometry, axesGeometry, BOX } from "../../src/shapes/solids";

const ARROW = { shaftLength: 2, shaftDiameter: 0.1, headLength: 0.5, headDiameter: 0.4 };

function size(box: Box3): number[] {
  return box.getSize(new Vector3()).toArray();
}

describe("arrows", () => {
  it("reach along x from the origin, as thick as their heads", () => {
    const box = new Box3().setFromObject(new Arrow(ARROW));
    expect(box.min.x).toBeCloseTo(0);
    expect(size(box)[0]).toBeCloseTo(2.5);
    expect(size(box)[2]).toBeCloseTo(0.4);
  });

  it("have the same measures as the geometry of their instances", () => {
    const geometry = arrowGeometry(ARROW);
    geometry.computeBoundingBox();
    expect(size(geometry.boundingBox ?? new Box3())[0]).toBeCloseTo(2.5);
    expect(size(geometry.boundingBox ?? new Box3())[2]).toBeCloseTo(0.4);
  });
});

describe("axes", () => {
  it("have a radius that is the diameter of their cylinders, as rviz's", () => {
    const box = new Box3().setFromObject(new Axes(1, 0.1));
    expect(box.min.y).toBeCloseTo(-0.05);
    for (const part of box.max.toArray()) expect(part).toBeCloseTo(1);
  });

  it("are red, green and blue along x, y and z", () => {
    const geometry = axesGeometry(1, 0.1);
    const [position, color] = [geometry.getAttribute("position"), geometry.getAttribute("vertexRgba")];
    for (let vertex = 0; vertex < position.count; vertex++) {
      const along = [position.getX(vertex), position.getY(vertex), position.getZ(vertex)].findIndex(
        (part) => part > 0.9,
      );
      if (along >= 0) expect([color.getX(vertex), color.getY(vertex), color.getZ(vertex)][along]).toBe(1);
    }
  });
});

describe("instances", () => {
  it("recompile their program when a color becomes transparent", () => {
    const boxes = new Instances(BOX);
    const color = (alpha: number): number => {
      boxes.begin(1);
      boxes.setRgbaAt(0, 1, 0, 0, alpha);
      boxes.finish();
      return boxes.material.version;
    };
    const opaque = color(1);

    expect(color(0.5)).toBe(opaque + 1);
    expect(color(0.4)).toBe(opaque + 1);
    expect(color(1)).toBe(opaque + 2);
  });

  it("grow and keep their matrices and colors", () => {
    const instances = new Instances(BOX, {}, 1);
    instances.begin(1);
    instances.setMatrixAt(0, new Matrix4().makeTranslation(1, 2, 3));
    instances.resize(40);
    instances.setMatrixAt(39, new Matrix4());
    const matrix = new Matrix4();
    instances.getMatrixAt(0, matrix);
    expect(new Vector3().setFromMatrixPosition(matrix).toArray()).toEqual([1, 2, 3]);
  });

  it("are blended when one of them is transparent", () => {
    const instances = new Instances(BOX);
    instances.begin(2);
    instances.setRgbaAt(0, 1, 0, 0, 1);
    instances.setRgbaAt(1, 1, 0, 0, 0.5);
    instances.finish();
    expect(instances.material.transparent).toBe(true);
    instances.begin(1);
    instances.setRgbaAt(0, 1, 0, 0, 1);
    instances.finish();
    expect(instances.material.transparent).toBe(false);
  });
});

describe("billboard lines", () => {
  it("join a closed line's last point to its first, and are picked within their width", () => {
    const lines = new BillboardLines(0.2);
    lines.begin();
    lines.addPolyline([0, 0, 0, 1, 0, 0, 1, 1, 0], [1, 0, 0, 1], true);
    lines.finish();
    expect(lines.segments).toBe(3);
    const down = (x: number, y: number): number =>
      new Raycaster(new Vector3(x, y, 5), new Vector3(0, 0, -1)).intersectObject(lines).length;
    expect(down(0.5, 0.05)).toBe(1);
    expect(down(0.5, 0.25)).toBe(0);
  });

  it("grow beyond what was reserved", () => {
    const lines = new BillboardLines();
    lines.begin();
    for (let k = 0; k < 100; k++) lines.addSegment([k, 0, 0], 0, [k, 1, 0], 0, [1, 1, 1, 1], [1, 1, 1, 0.5]);
    lines.finish();
    expect(lines.segments).toBe(100);
    expect(lines.geometry.getAttribute("segmentStart").getX(99)).toBe(99);
    expect(lines.material.transparent).toBe(true);
  });
});

describe("covariances", () => {
  it("have principal axes that give the matrix back", () => {
    const matrix = [2, 0.5, 0.1, 0.5, 1, -0.3, 0.1, -0.3, 0.7];
    const { values, rotation } = principalAxes(matrix);
    const columns = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((axis) =>
      axis.applyQuaternion(rotation).toArray(),
    );
    for (let row = 0; row < 3; row++) {
      for (let column = 0; column < 3; column++) {
        const sum = columns.reduce(
          (all, axis, k) => all + (values[k] ?? 0) * (axis[row] ?? 0) * (axis[column] ?? 0),
          0,
        );
        expect(sum).toBeCloseTo(matrix[3 * row + column] ?? NaN, 9);
      }
    }
  });

  it("of a planar pose are a flat ellipse of two standard deviations and a triangle", () => {
    const covariance = new Float64Array(36);
    covariance[0] = 0.25;
    covariance[7] = 0.04;
    covariance[35] = 0.01;
    const visual = new CovarianceVisual(new CovarianceProperty());
    visual.setCovariance(covariance, new Quaternion());
    const [ellipsoid, turn] = visual.children;
    expect(ellipsoid?.scale.x).toBeCloseTo(1);
    expect(ellipsoid?.scale.y).toBeCloseTo(0.4);
    expect(ellipsoid?.scale.z).toBeCloseTo(0.001);
    const triangle = turn?.children.at(-1);
    expect(triangle?.visible).toBe(true);
    expect(triangle?.scale.y).toBeCloseTo(2 * Math.tan(0.1));
  });

  it("of a pose in space spread the disc on x along z with the pitch's deviation", () => {
    const covariance = new Float64Array(36);
    for (const [at, value] of [
      [0, 1],
      [7, 1],
      [14, 1],
      [21, 0.01],
      [28, 0.09],
      [35, 0.04],
    ] as const)
      covariance[at] = value;
    const visual = new CovarianceVisual(new CovarianceProperty());
    visual.setCovariance(covariance, new Quaternion());
    const roll = visual.children[1]?.children[0];
    const box = new Box3().setFromObject(roll ?? visual);
    expect(size(box)[2]).toBeCloseTo(2 * Math.tan(0.3), 2);
    expect(size(box)[1]).toBeCloseTo(2 * Math.tan(0.2), 2);
    expect(box.getCenter(new Vector3()).x).toBeCloseTo(1);
  });
});
