/** Services: the form of a request, the call and its answer (rqt_service_caller). */

import { computed, signal } from "@preact/signals";
import type { JSX } from "preact";

import { Controls } from "../page/view_only";
import type { Connection, ServiceInfo } from "../protocol/connection";
import type { RosMessage } from "../protocol/ros_types";
import { Button } from "../theme/button";
import { MessageType } from "./messages/definition";
import { FormState } from "./messages/form_state";
import { MessageForm } from "./messages/message_form";
import { MessageTree } from "./messages/message_tree";
import type { Panel, PanelProps } from "./panel";
import { FilterButton, FilterField, Split } from "./parts";
import { perPage } from "./per_page";
import { sentence } from "./use";

/** Request that a person fills in, and its response. */
class Call {
  readonly form: FormState;
  readonly answer = signal<RosMessage | null>(null);
  readonly fault = signal("");
  readonly isRunning = signal(false);

  constructor(
    private readonly connection: Connection,
    readonly service: ServiceInfo,
  ) {
    let form = new FormState(MessageType.parse(""));
    try {
      form = new FormState(MessageType.parse(service.request));
    } catch (error) {
      this.fault.value = `There is no form for ${service.type}: ${sentence(error)}`;
    }
    this.form = form;
  }

  async run(): Promise<void> {
    const { message, faults } = this.form.build(this.connection.now());
    this.answer.value = null;
    const [fault] = faults.values();
    this.fault.value = fault ?? "";
    if (fault !== undefined) return;
    this.isRunning.value = true;
    try {
      this.answer.value = await this.connection.callService(this.service.name, message);
    } catch (error) {
      this.fault.value = sentence(error);
    }
    this.isRunning.value = false;
  }
}

class ServicesState {
  readonly filter = signal("");
  readonly isFiltering = signal(false);
  readonly selected = signal<string | null>(null);
  private readonly calls = new Map<string, Call>();

  constructor(private readonly connection: Connection) {}

  readonly shown = computed(() => {
    const part = this.filter.value.trim().toLowerCase();
    return [...this.connection.services.value.values()]
      .filter(({ name, type }) => name.toLowerCase().includes(part) || type.toLowerCase().includes(part))
      .sort((one, other) => (one.name < other.name ? -1 : 1));
  });

  /** Call of a service; a new one if its definition changed. */
  call(service: ServiceInfo): Call {
    const known = this.calls.get(service.name);
    if (known?.service.request === service.request) return known;
    const call = new Call(this.connection, service);
    this.calls.set(service.name, call);
    return call;
  }
}

const servicesState = perPage((page) => new ServicesState(page.connection));

function Services({ page }: PanelProps): JSX.Element {
  const state = servicesState(page);
  const selected = page.connection.services.value.get(state.selected.value ?? "");
  const providers = page.connection.graph.value.services;
  return (
    <Split
      head={state.isFiltering.value && <FilterField label="Filter services" value={state.filter} />}
      detail={
        selected !== undefined && (
          <Detail
            key={selected.name}
            page={page}
            call={state.call(selected)}
            onClose={() => void (state.selected.value = null)}
          />
        )
      }
    >
      {state.shown.value.length === 0 && <div class="empty">There are no services.</div>}
      {state.shown.value.length > 0 && (
        <table class="data">
          <thead>
            <tr>
              <th>Service</th>
              <th>Type</th>
              <th>Node</th>
            </tr>
          </thead>
          <tbody>
            {state.shown.value.map(({ name, type }) => (
              <tr
                key={name}
                class={selected?.name === name ? "sel" : ""}
                onClick={() => void (state.selected.value = name)}
              >
                <td>
                  <button type="button" class="cell" aria-expanded={selected?.name === name}>
                    {name}
                  </button>
                </td>
                <td class="t2">{type}</td>
                <td class="t2">{(providers.get(name) ?? []).join(", ")}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </Split>
  );
}

function Detail({
  page,
  call,
  onClose,
}: PanelProps & { readonly call: Call; readonly onClose: () => void }): JSX.Element {
  const { service, form, answer, fault, isRunning } = call;
  return (
    <>
      <div class="toolrow">
        <strong class="n">{service.name}</strong>
        <span class="sp" />
        <Controls page={page}>
          <Button small tone="line" disabled={isRunning.value} onClick={() => void call.run()}>
            {isRunning.value ? "Calling …" : "Call"}
          </Button>
        </Controls>
        <Button small icon="close" label="Close" onClick={onClose} />
      </div>
      <div class="scroll">
        {form.rows.length > 0 && <MessageForm label={`Request of ${service.name}`} form={form} />}
        {form.rows.length === 0 && <div class="empty">The request has no fields.</div>}
        {fault.value !== "" && (
          <div class="fault pad" role="alert">
            {fault.value}
          </div>
        )}
        {answer.value !== null && (
          <div role="status">
            <h2 class="headline">Answer</h2>
            {Object.keys(answer.value).length === 0 ? (
              <div class="empty">Done; the answer has no fields.</div>
            ) : (
              <MessageTree label={`Answer of ${service.name}`} type={service.type} message={answer.value} />
            )}
          </div>
        )}
      </div>
    </>
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = servicesState(page);
  return <FilterButton on={state.isFiltering} text={state.filter} />;
}

export const servicesPanel: Panel = {
  id: "services",
  title: "Services",
  programs: ["rqt_service_caller", "rqt_srv"],
  component: Services,
  actions: Actions,
};
