/** Sections of a link or model: pose, twist, mass and inertia, friction. */

import type { JSX } from "preact";

import type { LinkInfo, ModelInfo } from "../../protocol/generated/page_messages";
import type { Fields } from "../../protocol/connection";
import type { Transform } from "../../frames/transform";
import { count, fixed, plain } from "../../theme/format";
import { ModelButtons, WrenchSection } from "./handling_sections";
import { bodyValues } from "../../panels/plots/simulated_values";
import { PlotMenu } from "./plot_menu";
import { PoseSection } from "./pose_section";
import type { Shell } from "../shell";
import type { Twist } from "./twist";
import { TwistSection } from "./twist_section";
import { KeyValue, NumbersRow } from "./value_rows";
import { canEdit, editWorld } from "../world/edits";
import { bodiesOf } from "../../page/world_nodes";
import { poseFields, withNumber } from "../../page/request_fields";

/** Smallest and largest mass of a link that the server accepts [kg]. */
const MASSES = { min: 1e-6, max: 1e6 };

interface ModelProps {
  readonly shell: Shell;
  /** Full name: `outer::inner`. */
  readonly name: string;
  readonly model: ModelInfo;
}

export function ModelSections({ shell, name, model }: ModelProps): JSX.Element {
  const { page } = shell;
  const mass = model.links.reduce((sum, link) => sum + link.mass, 0);
  const [first] = bodiesOf(model);
  const [link] = model.links;
  const move = canEdit(shell) && link !== undefined ? mover(shell, name, link) : undefined;
  const setTwist = (after: Twist, before: Twist): void => {
    void editWorld(shell, `Twist of ${name}`, "twist", { model: name, ...after }, { model: name, ...before });
  };
  return (
    <>
      {first !== undefined && (
        <PoseSection
          key={first}
          within="world"
          menu={<PlotMenu shell={shell} owner={name} values={bodyValues(model)} />}
          pose={() => page.world.pose(first)}
          onCommit={move}
        />
      )}
      {first !== undefined && !model.static && (
        <TwistSection
          key={`twist ${first}`}
          page={page}
          body={first}
          onCommit={canEdit(shell) ? setTwist : undefined}
        />
      )}
      <section class="sec">
        <h3>Model</h3>
        {!model.static && <KeyValue name="Mass" value={fixed(mass, 3)} unit="kg" />}
        <KeyValue name="Links" value={count(model.links.length, "link")} />
        <KeyValue name="Base" value={model.static ? "static" : model.held ? "held in the air" : "free"} />
        {canEdit(shell) && <ModelButtons shell={shell} name={name} model={model} />}
      </section>
    </>
  );
}

/** Function that moves a model so that one of its links has a given pose. */
function mover(shell: Shell, model: string, { name }: LinkInfo): (after: Transform, before: Transform) => void {
  const fields = ({ position, orientation }: Transform): Fields<"pose"> => ({
    model,
    link: name,
    ...poseFields(position, orientation),
  });
  return (after, before) => {
    void editWorld(shell, `Pose of ${model}`, "pose", fields(after), fields(before));
  };
}

interface LinkProps {
  readonly shell: Shell;
  readonly model: string;
  readonly link: LinkInfo;
  readonly isStatic: boolean;
}

export function LinkSections({ shell, model, link, isStatic }: LinkProps): JSX.Element {
  const { page } = shell;
  return (
    <>
      <PoseSection
        key={link.body}
        within="world"
        menu={<PlotMenu shell={shell} owner={`${model}::${link.name}`} values={bodyValues({ static: isStatic })} />}
        pose={() => page.world.pose(link.body)}
        onCommit={canEdit(shell) ? mover(shell, model, link) : undefined}
      />
      {!isStatic && <TwistSection key={`twist ${link.body}`} page={page} body={link.body} />}
      {!isStatic && <Inertia shell={shell} model={model} link={link} />}
      {!isStatic && canEdit(shell) && (
        <WrenchSection key={`force ${link.body}`} shell={shell} model={model} link={link.name} />
      )}
      {link.friction !== null && <Friction shell={shell} model={model} link={link.name} friction={link.friction} />}
      {link.sensors.length > 0 && (
        <section class="sec">
          <h3>Sensors</h3>
          {link.sensors.map((sensor) => (
            <KeyValue
              key={sensor.name}
              name={sensor.topic ?? sensor.name}
              value={`${sensor.type} ${fixed(sensor.rate, 0)}`}
              unit="Hz"
            />
          ))}
        </section>
      )}
    </>
  );
}

function Inertia({ shell, model, link }: Omit<LinkProps, "isStatic">): JSX.Element {
  const [ixx, iyy, izz, ixy, ixz, iyz] = link.inertia;
  const [x, y, z] = link.inertial_pose;
  const fields = (mass: number): Fields<"mass"> => ({ model, link: link.name, mass });
  const set = (mass: number): void =>
    void editWorld(shell, `Mass of ${link.name}`, "mass", fields(mass), fields(link.mass));
  return (
    <section class="sec">
      <h3>Mass and inertia</h3>
      {canEdit(shell) ? (
        <NumbersRow
          name="Mass"
          labels={["Mass"]}
          values={[link.mass]}
          unit="kg"
          {...MASSES}
          onCommit={(_, mass) => set(mass)}
        />
      ) : (
        <KeyValue name="Mass" value={fixed(link.mass, 3)} unit="kg" />
      )}
      <KeyValue name="Center of mass" value={row([x, y, z], 3)} unit="m" />
      <KeyValue name="ixx · iyy · izz" value={row([ixx, iyy, izz], 4)} unit="kg m²" />
      {[ixy, ixz, iyz].some((product) => product !== 0) && (
        <KeyValue name="ixy · ixz · iyz" value={row([ixy, ixz, iyz], 4)} unit="kg m²" />
      )}
    </section>
  );
}

interface FrictionProps {
  readonly shell: Shell;
  readonly model: string;
  readonly link: string;
  readonly friction: readonly [number, number];
}

function Friction({ shell, model, link, friction }: FrictionProps): JSX.Element {
  const fields = ([mu, mu2]: readonly [number, number]): Fields<"friction"> => ({ model, link, mu, mu2 });
  const set = (index: number, value: number): void =>
    void editWorld(
      shell,
      `Friction of ${link}`,
      "friction",
      fields(withNumber(friction, index, value)),
      fields(friction),
    );
  return (
    <section class="sec">
      <h3>Friction</h3>
      {canEdit(shell) && friction.every((mu) => mu >= 0) ? (
        <NumbersRow name="mu · mu2" labels={["mu", "mu2"]} values={friction} min={0} max={1e6} onCommit={set} />
      ) : (
        <KeyValue
          name="mu · mu2"
          value={friction.map((mu) => (Number.isInteger(mu) ? fixed(mu, 1) : plain(mu))).join(" · ")}
        />
      )}
    </section>
  );
}

/** Numbers with fixed decimals; zeros plain. */
function row(values: readonly number[], decimals: number): string {
  return values.map((value) => (value === 0 ? "0" : fixed(value, decimals))).join(" · ");
}
