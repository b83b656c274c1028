/** A server of dynamic_reconfigure: its description, its values, and changes to them. */

import { signal } from "@preact/signals";

import type { UndoStack } from "../../displays/undo_stack";
import type { Connection, Subscription, TopicInfo } from "../../protocol/connection";
import { sentence } from "../use";
import {
  configValues,
  describedGroups,
  setRequest,
  type Option,
  type OptionGroup,
  type OptionValue,
  type OptionValues,
} from "./reconfigure_config";

const DESCRIPTIONS = "/parameter_descriptions";

/** Names of the servers: nodes that describe their options. */
export function serverNames(topics: ReadonlyMap<string, TopicInfo>): readonly string[] {
  return [...topics.values()]
    .filter(({ name, type }) => name.endsWith(DESCRIPTIONS) && type === "dynamic_reconfigure/ConfigDescription")
    .map(({ name }) => name.slice(0, -DESCRIPTIONS.length))
    .sort();
}

export class ReconfigureServer {
  /** Null until the description has come. */
  readonly groups = signal<readonly OptionGroup[] | null>(null);
  readonly values = signal<OptionValues>(new Map());
  readonly fault = signal("");
  private readonly subscriptions: readonly Subscription[];

  constructor(
    private readonly connection: Connection,
    private readonly undo: UndoStack,
    readonly name: string,
  ) {
    const onError = (text: string): void => void (this.fault.value = text);
    this.subscriptions = [
      connection.subscribe(
        `${name}${DESCRIPTIONS}`,
        ({ message }) => void (this.groups.value = describedGroups(message)),
        { onError },
      ),
      connection.subscribe(
        `${name}/parameter_updates`,
        ({ message }) => void (this.values.value = configValues(message)),
        { onError },
      ),
    ];
  }

  close(): void {
    for (const subscription of this.subscriptions) subscription.close();
  }

  value(option: Option): OptionValue | undefined {
    return this.values.value.get(option.name) ?? option.initial;
  }

  /** Set an option, undoable. */
  change(option: Option, value: OptionValue): void {
    const old = this.value(option);
    if (old === undefined) this.set(option, value);
    else this.commit(option, old, value);
  }

  /** Set an option; undo restores the old value. */
  commit(option: Option, old: OptionValue, value: OptionValue): void {
    this.undo.run(
      `Change of ${option.name}`,
      () => this.set(option, value),
      () => this.set(option, old),
    );
  }

  /** Set an option now, as a slider does while it is dragged. */
  set(option: Option, value: OptionValue): void {
    this.values.value = new Map(this.values.peek()).set(option.name, value);
    this.connection.callService(`${this.name}/set_parameters`, setRequest(option, value)).then(
      (answer) => {
        this.fault.value = "";
        const values = configValues(answer["config"]);
        if (values.size > 0) this.values.value = values;
      },
      (error: unknown) => void (this.fault.value = sentence(error)),
    );
  }
}
