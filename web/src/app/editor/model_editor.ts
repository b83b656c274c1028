/** Edits of the draft: requests to the server, which answers with the edited draft. */

import { computed, signal } from "@preact/signals";
import { Box3, Vector3 } from "three";

import type { AddPart, DraftInfo } from "../../protocol/generated/page_messages";
import type { Notices } from "../notices/notices";
import type { Page } from "../../page/page";
import { bodiesOf } from "../../page/world_nodes";
import type { Transform } from "../../frames/transform";
import type { Answer, Fields, RequestName } from "../../protocol/connection";
import type { FieldValue, PartPath } from "../../scene/draft";
import { poseFields } from "../../page/request_fields";

/** Distance from the other models to a new one, and half the width of the view around it [m]. */
const BESIDE = 1.5;

/** Question to the person before an action. */
export interface Question {
  readonly title: string;
  readonly text: string;
  readonly action: string;
  readonly run: () => void;
}

export class ModelEditor {
  readonly draft = computed<DraftInfo | null>(() => this.page.world.manifest.value?.draft ?? null);
  readonly question = signal<Question | null>(null);

  constructor(
    private readonly page: Page,
    private readonly notices: Notices,
  ) {
    page.undo.defer(
      computed(() => {
        const draft = this.draft.value;
        if (draft === null) return null;
        return {
          undoTitle: draft.undo,
          redoTitle: draft.redo,
          undo: () => void this.ask("Undo", "draft_undo", {}),
          redo: () => void this.ask("Redo", "draft_redo", {}),
        };
      }),
    );
  }

  /** Edit a copy of a model, or a new model next to all movable ones. */
  async begin(model: string | null): Promise<void> {
    const { world, views } = this.page;
    const movable = (world.manifest.peek()?.models ?? []).filter((model) => !model.static);
    const box = world.bounds(movable.flatMap(bodiesOf));
    const x = box.isEmpty() ? 0 : Math.ceil(10 * (box.max.x + BESIDE)) / 10;
    const answer = await this.ask("Edit model", "begin_draft", { model, position: [x, 0, 0] });
    if (answer === null) return;
    this.select([]);
    if (model === null) views.frame(new Box3(new Vector3(x - BESIDE, -BESIDE, 0), new Vector3(x + BESIDE, BESIDE, 1)));
  }

  set(part: PartPath, field: string, value: FieldValue): void {
    const selection = this.page.selection.peek();
    void this.ask("Edit", "draft_set", { part, field, value }).then((answer) => {
      if (answer === null || field !== "@name" || selection !== this.page.selection.peek()) return;
      this.select(answer.part);
    });
  }

  place(part: PartPath, { position, orientation }: Transform): Promise<Answer<"draft_place"> | null> {
    return this.ask("Move", "draft_place", { part, ...poseFields(position, orientation) });
  }

  /** Add a part to the selected one, and select it. */
  async add(kind: AddPart["kind"], type: string): Promise<void> {
    const selection = this.page.selection.peek();
    await this.change("Add", "draft_add", { into: selection?.kind === "part" ? selection.part : [], kind, type });
  }

  async copy(part: PartPath): Promise<void> {
    await this.change("Copy", "draft_copy", { part });
  }

  async remove(part: PartPath): Promise<void> {
    await this.change("Remove", "draft_remove", { part });
  }

  /** Put the draft into the world; asks before a model's own code is run. */
  async finish(consent: string | null = null): Promise<void> {
    const answer = await this.ask("Finish", "draft_finish", { consent });
    if (answer === null) return;
    if ("name" in answer) {
      this.page.selection.value = { kind: "model", model: answer.name };
      return;
    }
    const text = `Plugins of this model are programs, which would run on the machine that simulates: ${answer.code.join(", ")}`;
    this.question.value = {
      title: "Run the model's code?",
      text,
      action: "Run it",
      run: () => void this.finish(answer.consent),
    };
  }

  leave(): void {
    const throwAway = (): void => {
      void this.ask("Leave", "draft_leave", {}).then((answer) => {
        if (answer !== null) this.page.selection.value = null;
      });
    };
    if (this.draft.peek()?.undo == null) throwAway();
    else
      this.question.value = {
        title: "Leave the editor?",
        text: "Changes that are not saved are discarded.",
        action: "Discard",
        run: throwAway,
      };
  }

  async ask<N extends RequestName>(title: string, request: N, fields: Fields<N>): Promise<Answer<N> | null> {
    try {
      return await this.page.connection.request(request, fields);
    } catch (error) {
      this.notices.report(title, error instanceof Error ? error.message : String(error));
      return null;
    }
  }

  private async change<N extends "draft_add" | "draft_copy" | "draft_remove">(
    title: string,
    request: N,
    fields: Fields<N>,
  ): Promise<void> {
    const answer = await this.ask(title, request, fields);
    if (answer !== null) this.select(answer.part);
  }

  private select(part: PartPath): void {
    this.page.selection.value = { kind: "part", part };
  }
}
