// @vitest-environment jsdom
import { Mesh, Vector3, type Object3D } from "three";
import { describe, expect, it } from "vitest";

import { RobotModel } from "../../src/displays/robot_model";
import { readUrdf, UrdfError } from "../../src/displays/robot/urdf";
import { ShapeMaterial } from "../../src/shapes/shape_material";
import { setup, type Setup } from "./support";

const URDF = `<?xml version="1.0"?>
<robot name="cart">
  <material name="orange"><color rgba="1 0.5 0 1"/></material>
  <link name="base">
    <visual><origin xyz="0 0 0.5"/><geometry><box size="2 1 0.4"/></geometry><material name="orange"/></visual>
    <collision><geometry><sphere radius="0.3"/></geometry></collision>
  </link>
  <link name="wheel">
    <visual><geometry><mesh filename="package://cart/wheel.stl" scale="2 2 2"/></geometry></visual>
  </link>
  <link name="mark"/>
  <joint name="axle" type="continuous">
    <parent link="base"/><child link="wheel"/><axis xyz="0 1 0"/><limit effort="20"/>
  </joint>
</robot>`;

const STL = `solid
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid`;

function bytes(text: string): ArrayBuffer {
  return new TextEncoder().encode(text).buffer;
}

function started(urdf: string | undefined, properties: Record<string, unknown> = {}): Setup & { robot: RobotModel } {
  const base = setup();
  base.frames.set("base", "map", [1, 0, 0]);
  base.frames.set("wheel", "map", [3, 0, 0]);
  base.frames.set("mark", "map", [0, 5, 0]);
  if (urdf !== undefined) base.connection.setParameter("/robot_description", urdf);
  const robot = new RobotModel(base.context);
  robot.load(properties as never);
  robot.start();
  robot.update(1n, 1);
  return { ...base, robot };
}

function meshes(object: Object3D | undefined): Mesh[] {
  const meshes: Mesh[] = [];
  object?.traverseVisible((part) => {
    if (part instanceof Mesh) meshes.push(part as Mesh);
  });
  return meshes;
}

function rgba(mesh: Mesh | undefined): number[] {
  return mesh?.material instanceof ShapeMaterial ? mesh.material.color.toArray() : [];
}

describe("RobotModel", () => {
  it("places each link at its frame, with the color of its material", () => {
    const { robot } = started(URDF);
    const [box] = meshes(robot.root.getObjectByName("base"));
    robot.root.updateMatrixWorld(true);
    expect(new Vector3().setFromMatrixPosition(box?.matrixWorld ?? robot.root.matrixWorld).toArray()).toEqual([
      1, 0, 0.5,
    ]);
    expect(rgba(box)).toEqual([1, 0.5, 0, 1]);
    expect(robot.statuses.value.get("URDF")?.text).toBe("URDF parsed OK");
  });

  it("loads meshes by their address, scaled, and red where the URDF names no color", async () => {
    const base = setup();
    base.connection.assets.set("package://cart/wheel.stl", bytes(STL));
    base.connection.setParameter("/robot_description", URDF);
    base.frames.set("wheel", "map");
    const robot = new RobotModel(base.context);
    robot.start();
    await settle();
    robot.update(1n, 1);
    const [wheel] = meshes(robot.root.getObjectByName("wheel"));
    expect(rgba(wheel)).toEqual([1, 0, 0, 1]);
    robot.root.updateMatrixWorld(true);
    expect(wheel?.getWorldScale(new Vector3()).x).toBeCloseTo(2);
  });

  it("names a mesh that is missing, with the reason", async () => {
    const { robot } = started(URDF);
    await settle();
    expect(robot.statuses.value.get("Mesh package://cart/wheel.stl")).toMatchObject({
      level: "error",
      text: "Could not load mesh resource 'package://cart/wheel.stl'",
      advice: "there is no package://cart/wheel.stl",
    });
  });

  it("reports a link without a transform, as rviz, and shows it white", () => {
    const { robot, frames } = started(URDF);
    frames.forget("base");
    robot.update(2n, 1);
    expect(robot.statuses.value.get("base")?.text).toBe("No transform from [base] to [map]");
    expect(rgba(meshes(robot.root.getObjectByName("base"))[0])).toEqual([1, 1, 1, 1]);
    frames.set("base", "map");
    robot.update(3n, 1);
    expect(robot.statuses.value.get("base")?.text).toBe("Transform OK");
  });

  it("looks up frames with the tf prefix", () => {
    const { robot } = started(URDF, { "TF Prefix": "robot1" });
    expect(robot.statuses.value.get("base")?.text).toBe("No transform from [robot1/base] to [map]");
  });

  it("applies saved alphas and disabled links when the robot appears later", () => {
    const { robot, connection } = started(undefined, {
      Alpha: 0.5,
      Links: {
        "All Links Enabled": true,
        base: { Alpha: 0.5, "Show Axes": true, Value: true },
        wheel: { Value: false },
      },
    });
    expect(robot.statuses.value.get("URDF")?.text).toBe(
      "Parameter [robot_description] does not exist, and was not found by searchParam()",
    );
    connection.setParameter("/robot_description", URDF);
    const base = robot.root.getObjectByName("base");
    expect(rgba(meshes(base)[0])).toEqual([1, 0.5, 0, 0.25]);
    expect(meshes(base)).toHaveLength(1 + 3);
    expect(meshes(robot.root.getObjectByName("wheel"))).toEqual([]);
  });

  it("shows collisions instead of visuals when asked, in the color of the visual", () => {
    const { robot } = started(URDF, { "Visual Enabled": false, "Collision Enabled": true });
    const [sphere] = meshes(robot.root.getObjectByName("base"));
    expect(sphere?.scale.x).toBeCloseTo(0.6);
    expect(rgba(sphere)).toEqual([1, 0.5, 0, 1]);
  });

  it("is rebuilt when the description changes, and reports an invalid one", () => {
    const { robot, connection } = started(URDF);
    connection.setParameter("/robot_description", "<robot><link name='base'></robot>");
    expect(robot.statuses.value.get("URDF")).toMatchObject({ level: "error", text: "URDF failed Model parse" });
    expect(robot.root.children).toHaveLength(0);
    connection.setParameter("/robot_description", URDF.replace("1 0.5 0 1", "0 0 1 1"));
    robot.update(2n, 1);
    expect(rgba(meshes(robot.root.getObjectByName("base"))[0])).toEqual([0, 0, 1, 1]);
  });

  it("takes the parameter's name from a topic of ROS 2", () => {
    const { robot } = started(URDF, { "Description Topic": { Value: "/robot_description" } });
    expect(robot.statuses.value.get("URDF")?.level).toBe("ok");
  });

  it("saves no rows for unchanged links", () => {
    const { robot } = started(URDF);
    expect(robot.save()["Links"]).toEqual({});
  });
});

describe("a robot description", () => {
  it("has joints with their limits", () => {
    expect(readUrdf(URDF).joints[0]).toMatchObject({
      name: "axle",
      type: "continuous",
      parent: "base",
      child: "wheel",
      axis: [0, 1, 0],
      effort: 20,
    });
  });

  it("is refused with a sentence if invalid", () => {
    expect(() => readUrdf("<sdf/>")).toThrow(UrdfError);
    expect(() => readUrdf("<sdf/>")).toThrow("The robot description begins with <sdf>, not <robot>.");
  });
});

async function settle(): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve, 20));
}
