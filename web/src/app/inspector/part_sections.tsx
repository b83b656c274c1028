/** Sections of a sensor and of a plugin. */

import type { JSX } from "preact";

import type { PluginInfo, SensorInfo } from "../../protocol/generated/page_messages";
import { plain } from "../../theme/format";
import type { Selection } from "../../page/page";
import type { Shell } from "../shell";
import { PlotMenu } from "./plot_menu";
import { KeyValue } from "./value_rows";

interface SensorProps {
  readonly shell: Shell;
  readonly selection: Extract<Selection, { readonly kind: "sensor" }>;
  readonly sensor: SensorInfo;
}

export function SensorSections({ shell, selection, sensor }: SensorProps): JSX.Element {
  const { type, rate, topic, series } = sensor;
  const owner = `${selection.model}::${selection.link}::${selection.sensor}`;
  return (
    <section class="sec">
      <h3>
        Sensor
        <span class="sp" />
        {series.length > 0 && <PlotMenu shell={shell} owner={owner} values={series} />}
      </h3>
      <KeyValue name="Type" value={type} />
      {rate > 0 ? <KeyValue name="Rate" value={plain(rate)} unit="Hz" /> : <KeyValue name="Rate" value="every step" />}
      {topic !== null && <KeyValue name="Topic" value={topic} />}
    </section>
  );
}

export function PluginSections({ plugin }: { readonly plugin: PluginInfo }): JSX.Element {
  const { filename, parameters } = plugin;
  return (
    <>
      <section class="sec">
        <h3>Plugin</h3>
        <KeyValue name="File" value={filename} />
      </section>
      {parameters.length > 0 && (
        <section class="sec">
          <h3>Parameters</h3>
          {parameters.map(([path, text], index) => (
            <KeyValue key={`${index} ${path}`} name={path} value={text} />
          ))}
        </section>
      )}
    </>
  );
}
