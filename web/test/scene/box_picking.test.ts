import "../../src/scene/conventions";

import {
  BoxGeometry,
  BufferGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Points,
  Vector3,
} from "three";
import { expect, test } from "vitest";

import { pickBox } from "../../src/scene/box_picking";

const SIZE = { width: 800, height: 600 };

function cameraAtX(): PerspectiveCamera {
  const camera = new PerspectiveCamera(50, SIZE.width / SIZE.height, 0.01, 100);
  camera.position.set(5, 0, 0);
  camera.lookAt(0, 0, 0);
  camera.updateProjectionMatrix();
  return camera;
}

test("a box picks meshes, instances and points whose middle it contains", () => {
  const inside = new Mesh(new BoxGeometry(0.2, 0.2, 0.2), new MeshBasicMaterial());
  const outside = new Mesh(new BoxGeometry(0.2, 0.2, 0.2), new MeshBasicMaterial());
  outside.position.set(0, 2, 0);
  const boxes = new InstancedMesh(new BoxGeometry(0.1, 0.1, 0.1), new MeshBasicMaterial(), 2);
  boxes.setMatrixAt(0, new Matrix4().makeTranslation(0, 2, 0));
  boxes.setMatrixAt(1, new Matrix4().makeTranslation(0, 0.1, 0));
  const points = new Points(
    new BufferGeometry().setFromPoints([new Vector3(0, 0, 0.1), new Vector3(0, -2, 0), new Vector3(20, 0, 0)]),
  );
  const root = new Group();
  root.add(inside, outside, boxes, points);
  root.updateMatrixWorld(true);
  const box = { left: 340, top: 240, right: 460, bottom: 360 };

  const picked = pickBox([root], cameraAtX(), SIZE, box, 10);

  expect(picked.map(({ object, index }) => [object.type, index])).toEqual([
    ["Mesh", null],
    ["Mesh", 1],
    ["Points", 0],
  ]);
  expect(pickBox([root], cameraAtX(), SIZE, box, 2)).toHaveLength(2);
});
