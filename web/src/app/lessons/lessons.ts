/** Lessons: the open lesson, its step, and the checks that are fulfilled. */

import { batch, computed, effect, signal, untracked } from "@preact/signals";

import { recall, remember } from "../../page/storage";
import type { Lesson, LessonEntry, LessonStep } from "../../protocol/generated/page_messages";
import type { Layout } from "../layout";
import { probe, watchProbes, type Progress, type Watched } from "./probe";

/** Parts of the page's shell that lessons use. */
interface Parts extends Watched {
  readonly layout: Layout;
}

export interface OpenLesson {
  readonly name: string;
  readonly lesson: Lesson;
}

/** State of a lesson that a browser remembers: its step, and the keys of the checks that were fulfilled. */
interface Remembered {
  readonly step: number;
  readonly done: readonly string[];
}

const NOTHING: Remembered = { step: 0, done: [] };
const OPEN = "lesson";
/** Time that a lesson's needs have to be fulfilled before they count as missing [ms]. */
const COMING = 2000;

export class Lessons {
  /** True while the side panel has the lessons' page. */
  readonly isShown = signal(false);
  /** Lessons that can be opened; null: they are not listed yet. */
  readonly list = signal<readonly LessonEntry[] | null>(null);
  readonly current = signal<OpenLesson | null>(null);
  /** Index of the step of the open lesson. */
  readonly at = signal(0);
  /** Keys of the checks that were fulfilled. */
  readonly done = signal<ReadonlySet<string>>(new Set());
  /** Progress of the step's checks, in their order. */
  readonly progress = signal<readonly Progress[]>([]);
  /** True if the lesson's needs are fulfilled, or may still be. */
  readonly hasNeeds = signal(true);
  /** Reason why a lesson could not be opened. */
  readonly fault = signal<string | null>(null);
  readonly step = computed<LessonStep | null>(() => this.current.value?.lesson.steps[this.at.value] ?? null);

  constructor(private readonly shell: Parts) {
    effect(() => this.watchStep());
    effect(() => this.watchNeeds());
    effect(() => {
      const open = this.current.value;
      const remembered: Remembered = { step: this.at.value, done: [...this.done.value] };
      if (open !== null) remember(keyOf(open.name), remembered);
    });
  }

  /** Once the page is connected, open the session's lesson, or the one that was open when the person left the page. */
  start(): void {
    const { connection, session } = this.shell.page;
    const left = recall(OPEN, null, (value): value is string | null => typeof value === "string");
    const name = session.lesson ?? left;
    if (name === null) return;
    const stop = connection.state.subscribe(({ kind }) => {
      if (kind !== "connected") return;
      queueMicrotask(() => stop()); // later: `stop` is not yet defined in the first call
      void this.open(name, { isRecalled: session.lesson === null });
    });
  }

  /** Show the page of lessons; close it if it is shown. */
  toggle(): void {
    const { layout } = this.shell;
    if (this.isShown.peek() && layout.right.page.peek() === "lesson" && !layout.isRail("right")) this.close();
    else this.show();
  }

  close(): void {
    this.leave();
    this.isShown.value = false;
    const { right } = this.shell.layout;
    if (right.page.peek() === "lesson") right.page.value = "inspector";
  }

  private show(): void {
    this.isShown.value = true;
    this.shell.layout.open("lesson");
    void this.update();
  }

  /** Ask for the list of lessons. */
  private async update(): Promise<void> {
    await this.attempt(async () => {
      const { lessons } = await this.shell.page.connection.request("lessons", {});
      this.list.value = lessons;
    });
  }

  /** Open a lesson at the step where the person left it; `isRecalled`: no fault if the lesson no longer exists. */
  async open(name: string, { isRecalled = false } = {}): Promise<void> {
    await this.attempt(async () => {
      const { lesson } = await this.shell.page.connection.request("lesson", { name });
      const { step, done } = recall(keyOf(name), NOTHING, isRemembered);
      batch(() => {
        this.current.value = { name, lesson };
        this.at.value = Math.min(step, lesson.steps.length - 1);
        this.done.value = new Set(done);
        this.isShown.value = true;
      });
      remember(OPEN, name);
      if (!isRecalled) this.shell.layout.open("lesson");
    });
    if (isRecalled) this.fault.value = null;
    else if (this.current.peek() === null) this.show();
  }

  /** Return to the list. */
  leave(): void {
    this.current.value = null;
    remember(OPEN, null);
    void this.update();
  }

  restart(): void {
    this.done.value = new Set();
    this.at.value = 0;
  }

  /** Number of steps of the open lesson that are done. */
  isDone(index: number): boolean {
    const step = this.current.value?.lesson.steps[index];
    if (step === undefined) return false;
    return step.checks.length === 0
      ? index < this.at.value
      : step.checks.every((_, check) => this.done.value.has(checkKey(step, index, check)));
  }

  private async attempt(work: () => Promise<void>): Promise<void> {
    this.fault.value = null;
    try {
      await work();
    } catch (error) {
      this.fault.value = error instanceof Error ? error.message : String(error);
    }
  }

  /** Watch the checks of the step, from now on. */
  private watchStep(): (() => void) | undefined {
    const { current, at, step } = this;
    const [open, index, shown] = [current.value, at.value, step.value];
    this.progress.value = [];
    if (open === null || shown === null) return undefined;
    const ask = (check: number) => async () =>
      (await this.shell.page.connection.request("lesson_file", { lesson: open.name, step: index, check })).fault;
    return untracked(() =>
      watchProbes(
        shown.checks.map(({ check }, number) => probe(this.shell, check, ask(number))),
        (progress) => untracked(() => this.follow(shown, index, progress)),
      ),
    );
  }

  private follow(step: LessonStep, index: number, progress: readonly Progress[]): void {
    const keys = progress.flatMap(({ done }, check) => (done ? [checkKey(step, index, check)] : []));
    const done = this.done.peek();
    if (keys.some((key) => !done.has(key))) this.done.value = new Set([...done, ...keys]);
    this.progress.value = progress;
  }

  private watchNeeds(): (() => void) | undefined {
    const needs = this.current.value?.lesson.needs ?? [];
    this.hasNeeds.value = true;
    if (needs.length === 0) return undefined;
    const ask = (): Promise<string> => Promise.resolve("files are only checked in steps");
    let lackedSince = performance.now();
    return untracked(() =>
      watchProbes(
        needs.map(({ check }) => probe(this.shell, check, ask)),
        (progress) => {
          const now = performance.now();
          if (progress.some(({ done }) => done)) lackedSince = now;
          this.hasNeeds.value = now - lackedSince < COMING;
        },
      ),
    );
  }
}

function keyOf(name: string): string {
  return `lesson.${name}`;
}

/** Key of a check, which stays the same when other parts of the lesson's file are edited. */
export function checkKey(step: LessonStep, index: number, check: number): string {
  return `${index} ${step.checks[check]?.sentence}`;
}

function isRemembered(value: unknown): value is Remembered {
  if (typeof value !== "object" || value === null || !("step" in value && "done" in value)) return false;
  const { step, done } = value;
  return (
    Number.isInteger(step) && Number(step) >= 0 && Array.isArray(done) && done.every((key) => typeof key === "string")
  );
}
