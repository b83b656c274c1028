/** Publish on a topic: the form, once or at a rate. */

import type { JSX } from "preact";
import { useState } from "preact/hooks";

import { Button } from "../../theme/button";
import { NumberField } from "../../theme/number_field";
import { TextField } from "../../theme/text_field";
import { MessageForm } from "../messages/message_form";
import { FASTEST, type Publication } from "./publication";

export function TopicPublish({ publication }: { readonly publication: Publication }): JSX.Element {
  const form = publication.form.value;
  const [isYaml, setYaml] = useState(false);
  const { rate, isRunning, count, fault } = publication;
  return (
    <>
      <div class="toolrow">
        <Button small tone="line" disabled={form === null} onClick={() => publication.once()}>
          Publish once
        </Button>
        <Button
          small
          tone="line"
          icon={isRunning.value ? "pause" : "play"}
          disabled={form === null}
          onClick={() => (isRunning.value ? publication.stop() : publication.start())}
        >
          {isRunning.value ? "Stop" : "Publish at"}
        </Button>
        <span class="narrow">
          <NumberField
            label="Rate"
            unit="Hz"
            value={rate.value}
            min={0.01}
            max={FASTEST}
            class="small num"
            onCommit={(value) => publication.setRate(value)}
          />
        </span>
        {count.value > 0 && <span class="dim sm">{count.value} sent</span>}
        <span class="sp" />
        <Button small on={isYaml} disabled={form === null} onClick={() => setYaml(!isYaml)}>
          YAML
        </Button>
      </div>
      {fault.value !== "" && (
        <div class="fault pad" role="alert">
          {fault.value}
        </div>
      )}
      {isYaml && form !== null && (
        <div class="pad">
          <TextField
            label="Message as YAML"
            placeholder="{linear: {x: 0.2}}"
            value=""
            onCommit={(text) => {
              const refused = form.load(text);
              publication.fault.value = refused ?? "";
              if (refused === null) setYaml(false);
            }}
          />
        </div>
      )}
      {form !== null && <MessageForm label={`Message for ${publication.topic}`} form={form} />}
    </>
  );
}
