/** Sections of a link or model: pose, twist, mass and inertia, friction. */

import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";

import type { Transform } from "../frames/transform";
import type { LinkInfo, ModelInfo } from "../scene/simulated_world";
import { count, fixed, plain } from "../theme/format";
import type { Page } from "./page";
import { rollPitchYaw, twistOf, type StampedPose, type Twist } from "./twist";
import { bodiesOf } from "./world_nodes";

const REFRESH = 100; // ms

/** A value that is read again ten times a second. */
export function useSampled<T>(read: () => T): T {
  const [, refresh] = useState(0);
  useEffect(() => {
    const timer = setInterval(() => refresh((times) => times + 1), REFRESH);
    return () => clearInterval(timer);
  }, []);
  return read();
}

export function PoseSection({ within, pose }: { readonly within: string; readonly pose: () => Transform | null }): JSX.Element {
  const now = useSampled(pose);
  const angles = now === null ? null : rollPitchYaw(now.orientation);
  const degrees = (radians: number | undefined): string => fixed(radians === undefined ? null : (radians * 180) / Math.PI, 1);
  return (
    <section class="sec">
      <h3>
        Pose <span class="dim">in {within}</span>
      </h3>
      <div class="pose">
        {(["x", "y", "z"] as const).map((axis, index) => (
          <>
            <Reading key={axis} axis={axis} name={axis} value={fixed(now?.position[axis], 3)} unit="m" />
            <Reading key={`angle ${axis}`} axis={axis} name={["roll", "pitch", "yaw"][index] ?? ""} value={degrees(angles?.[index])} unit="°" />
          </>
        ))}
      </div>
    </section>
  );
}

interface ReadingProps {
  readonly axis: "x" | "y" | "z";
  readonly name: string;
  readonly value: string;
  readonly unit: string;
}

function Reading({ axis, name, value, unit }: ReadingProps): JSX.Element {
  return (
    <div class="nf">
      <span class="axis" style={{ "--ax": `var(--${axis})` }}>
        {name}
      </span>
      <output>{value}</output>
      <span class="unit">{unit}</span>
    </div>
  );
}

export function ModelSections({ page, model }: { readonly page: Page; readonly model: ModelInfo }): JSX.Element {
  const mass = model.links.reduce((sum, link) => sum + link.mass, 0);
  const [first] = bodiesOf(model);
  return (
    <>
      {first !== undefined && <PoseSection within="world" pose={() => page.world.pose(first)} />}
      <section class="sec">
        <h3>Model</h3>
        {!model.static && <KeyValue name="Mass" value={fixed(mass, 3)} unit="kg" />}
        <KeyValue name="Links" value={count(model.links.length, "link")} />
        <KeyValue name="Moves" value={model.static ? "no, it is static" : "yes"} />
      </section>
    </>
  );
}

export function LinkSections({ page, link, isStatic }: { readonly page: Page; readonly link: LinkInfo; readonly isStatic: boolean }): JSX.Element {
  const [ixx, iyy, izz, ixy, ixz, iyz] = link.inertia;
  const [x, y, z] = link.inertial_pose;
  return (
    <>
      <PoseSection key={link.body} within="world" pose={() => page.world.pose(link.body)} />
      {!isStatic && <TwistSection key={`twist ${link.body}`} page={page} body={link.body} />}
      {!isStatic && (
        <section class="sec">
          <h3>Mass and inertia</h3>
          <KeyValue name="Mass" value={fixed(link.mass, 3)} unit="kg" />
          <KeyValue name="Centre of mass" value={row([x, y, z], 3)} unit="m" />
          <KeyValue name="ixx · iyy · izz" value={row([ixx, iyy, izz], 4)} unit="kg m²" />
          {[ixy, ixz, iyz].some((product) => product !== 0) && <KeyValue name="ixy · ixz · iyz" value={row([ixy, ixz, iyz], 4)} unit="kg m²" />}
        </section>
      )}
      {link.friction !== null && (
        <section class="sec">
          <h3>Friction</h3>
          <KeyValue name="mu · mu2" value={link.friction.map((mu) => (Number.isInteger(mu) ? fixed(mu, 1) : plain(mu))).join(" · ")} />
        </section>
      )}
      {link.sensors.length > 0 && (
        <section class="sec">
          <h3>Sensors</h3>
          {link.sensors.map((sensor) => (
            <KeyValue key={sensor.name} name={sensor.topic ?? sensor.name} value={`${sensor.type} ${fixed(sensor.rate, 0)}`} unit="Hz" />
          ))}
        </section>
      )}
    </>
  );
}

/** Numbers with fixed decimals; zeros plain. */
function row(values: readonly number[], decimals: number): string {
  return values.map((value) => (value === 0 ? "0" : fixed(value, decimals))).join(" · ");
}

function KeyValue({ name, value, unit }: { readonly name: string; readonly value: string; readonly unit?: string }): JSX.Element {
  return (
    <div class="kv">
      <span>{name}</span>
      <span>
        {value}
        {unit !== undefined && <span class="unit">{unit}</span>}
      </span>
    </div>
  );
}

function TwistSection({ page, body }: { readonly page: Page; readonly body: number }): JSX.Element {
  const [before, setBefore] = useState<readonly StampedPose[]>([]);
  useEffect(() => {
    const timer = setInterval(() => {
      const pose = page.world.pose(body);
      const time = page.world.state.peek()?.time_ns ?? 0;
      if (pose === null) return;
      const sample = { time: time / 1e9, position: pose.position.clone(), orientation: pose.orientation.clone() };
      setBefore((samples) => (samples.at(-1)?.time === sample.time ? samples : [...samples.slice(-1), sample]));
    }, 2 * REFRESH);
    return () => clearInterval(timer);
  }, [page, body]);
  const [first, second] = before;
  const isMoving = page.world.state.value?.paused !== true;
  const twist = first === undefined || second === undefined || !isMoving ? null : twistOf(first, second);
  return (
    <section class="sec">
      <h3>
        Twist <span class="dim">in world</span>
      </h3>
      <div class="twist3">
        {["", "x", "y", "z", ""].map((head, index) => (
          <span key={index} class="h">
            {head}
          </span>
        ))}
        <TwistRow name="linear" values={twist?.linear} unit="m/s" />
        <TwistRow name="angular" values={twist?.angular} unit="rad/s" />
      </div>
    </section>
  );
}

function TwistRow({ name, values, unit }: { readonly name: string; readonly values: Twist["linear"] | undefined; readonly unit: string }): JSX.Element {
  return (
    <>
      <span>{name}</span>
      {[0, 1, 2].map((index) => (
        <span key={index}>{fixed(values?.[index], 2)}</span>
      ))}
      <span>{unit}</span>
    </>
  );
}
