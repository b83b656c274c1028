/** The Lesson page of the side panel: the list of lessons, or the step of one. */

import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { Icon } from "../../theme/icons";
import { StatusShape } from "../../theme/status_shape";
import type { LessonStep } from "../../protocol/generated/page_messages";
import type { Shell } from "../shell";
import { Blocks, Code } from "./blocks";
import { checkKey, type OpenLesson } from "./lessons";

interface ShellProps {
  readonly shell: Shell;
}

export function LessonPage({ shell }: ShellProps): JSX.Element {
  const open = shell.lessons.current.value;
  return open === null ? <LessonList shell={shell} /> : <LessonView shell={shell} open={open} />;
}

function LessonList({ shell }: ShellProps): JSX.Element {
  const { lessons } = shell;
  return (
    <div class="lesson scroll">
      <div class="head">
        <h2>Lessons</h2>
        <span class="sp" />
        <Button icon="close" label="Close the lessons" small onClick={() => lessons.close()} />
      </div>
      <p class="t2">Tutorials that check each step in this page.</p>
      <div class="choices">
        {lessons.list.value?.map(({ name, title }) => (
          <button key={name} type="button" class="b line" dir="auto" onClick={() => void lessons.open(name)}>
            <Icon name="lesson" />
            <span class="n">{title}</span>
          </button>
        ))}
      </div>
      <Fault shell={shell} />
      <p class="t2">A Markdown file of yours is a lesson, too:</p>
      <Code code={{ language: "bash", title: "", text: "trundle run model://rp2w --lesson FILE.md" }} />
    </div>
  );
}

function Fault({ shell }: ShellProps): JSX.Element | null {
  const fault = shell.lessons.fault.value;
  return fault === null ? null : (
    <p class="fault" role="alert">
      {fault}
    </p>
  );
}

function LessonView({ shell, open }: ShellProps & { readonly open: OpenLesson }): JSX.Element {
  const { lessons } = shell;
  const at = lessons.at.value;
  const { steps, title } = open.lesson;
  const step = steps[at];
  return (
    <>
      <div class="lesson head">
        <Button icon="back" label="All lessons" small onClick={() => lessons.leave()} />
        <h2 class="n" dir="auto" data-tip={title}>
          {title}
        </h2>
        <span class="sp" />
        <Button icon="reset" label="Start over" small onClick={() => lessons.restart()} />
        <Button icon="close" label="Close the lesson" small onClick={() => lessons.close()} />
      </div>
      <Steps shell={shell} steps={steps} />
      {step !== undefined && <Step key={at} shell={shell} step={step} index={at} open={open} />}
      <Foot shell={shell} count={steps.length} />
    </>
  );
}

/** A mark for each step, which leads to it. */
function Steps({ shell, steps }: ShellProps & { readonly steps: readonly LessonStep[] }): JSX.Element {
  const { lessons } = shell;
  return (
    <div class="steps" role="group" aria-label="Steps">
      {steps.map(({ title }, index) => {
        const isDone = lessons.isDone(index);
        const name = `Step ${index + 1}: ${title}${isDone ? ", done" : ""}`;
        return (
          <button
            key={index}
            type="button"
            class={isDone ? "done" : ""}
            aria-label={name}
            data-tip={name}
            aria-current={index === lessons.at.value ? "step" : undefined}
            onClick={() => (lessons.at.value = index)}
          />
        );
      })}
    </div>
  );
}

interface StepProps extends ShellProps {
  readonly step: LessonStep;
  readonly index: number;
  readonly open: OpenLesson;
}

function Step({ shell, step, index, open }: StepProps): JSX.Element {
  const { lessons } = shell;
  const { start } = open.lesson;
  return (
    <article class="lesson scroll" aria-label={step.title} tabIndex={0}>
      {!lessons.hasNeeds.value && (
        <div class="needs">
          <p>
            {start === "" ? "This lesson is about another world." : "This lesson is about another world. It starts by:"}
          </p>
          {start !== "" && <Code code={{ language: "bash", title: "", text: start }} />}
        </div>
      )}
      {index > 0 && <h3 dir="auto">{step.title}</h3>}
      <Blocks blocks={step.blocks} />
      {step.checks.length > 0 && (
        <ul class="checks" aria-label="Checks" aria-live="polite">
          {step.checks.map(({ sentence }, check) => {
            const isDone = lessons.done.value.has(checkKey(step, index, check));
            const detail = isDone ? "done" : (lessons.progress.value[check]?.detail ?? "");
            return (
              <li key={check} class={isDone ? "done" : ""}>
                <StatusShape level={isDone ? "ok" : "none"} label="" />
                <span dir="auto">
                  {sentence}
                  {detail !== "" && <span class={isDone ? "state" : "t2"}>: {detail}</span>}
                </span>
              </li>
            );
          })}
        </ul>
      )}
    </article>
  );
}

function Foot({ shell, count }: ShellProps & { readonly count: number }): JSX.Element {
  const { lessons } = shell;
  const at = lessons.at.value;
  const isDone = lessons.step.value?.checks.length === 0 || lessons.isDone(at);
  const go = (by: number) => (): void => {
    lessons.at.value = at + by;
  };
  return (
    <div class="foot">
      <Button small disabled={at === 0} onClick={go(-1)}>
        Back
      </Button>
      <span class="sp" />
      <span class="sm t2">
        Step {at + 1} of {count}
      </span>
      <span class="sp" />
      {at === count - 1 ? (
        <Button small tone={isDone ? "primary" : "line"} onClick={() => lessons.close()}>
          Finish
        </Button>
      ) : (
        <Button small tone={isDone ? "primary" : "line"} onClick={go(1)}>
          {isDone ? "Next" : "Skip"}
        </Button>
      )}
    </div>
  );
}
