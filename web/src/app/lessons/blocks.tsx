/** The text of a lesson, drawn as elements: it has no HTML of its own. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";

import type { CodeBlock, LessonStep, Paragraph } from "../../protocol/generated/page_messages";
import { Button } from "../../theme/button";

type Block = LessonStep["blocks"][number];
type Inline = Paragraph["content"][number];

export function Blocks({ blocks }: { readonly blocks: readonly Block[] }): JSX.Element {
  return (
    <>
      {blocks.map((block, index) => (
        <BlockView key={index} block={block} />
      ))}
    </>
  );
}

function BlockView({ block }: { readonly block: Block }): JSX.Element {
  switch (block.kind) {
    case "paragraph":
      return (
        <p dir="auto">
          <Inlines content={block.content} />
        </p>
      );
    case "heading":
      return (
        <h4 dir="auto">
          <Inlines content={block.content} />
        </h4>
      );
    case "quotation":
      return (
        <blockquote>
          <Blocks blocks={block.blocks} />
        </blockquote>
      );
    case "code_block":
      return <Code code={block} />;
    case "list": {
      const items = block.items.map((item, index) => (
        <li key={index}>
          <Blocks blocks={item} />
        </li>
      ));
      return block.ordered ? <ol start={block.first}>{items}</ol> : <ul>{items}</ul>;
    }
  }
}

function Inlines({ content }: { readonly content: readonly Inline[] }): JSX.Element {
  return (
    <>
      {content.map((part, index) => (
        <InlineView key={index} part={part} />
      ))}
    </>
  );
}

function InlineView({ part }: { readonly part: Inline }): JSX.Element {
  switch (part.kind) {
    case "text":
      return <>{part.text}</>;
    case "code":
      return <code>{part.text}</code>;
    case "break":
      return <br />;
    case "emphasis": {
      const content = <Inlines content={part.content} />;
      return part.strong ? <strong>{content}</strong> : <em>{content}</em>;
    }
    case "link":
      return (
        <a class="link" href={part.url} target="_blank" rel="noopener noreferrer">
          <Inlines content={part.content} />
        </a>
      );
  }
}

/** Lines of code; all but output has a button that copies it. */
export function Code({ code: { language, title, text } }: { readonly code: Omit<CodeBlock, "kind"> }): JSX.Element {
  const lines = useRef<HTMLElement>(null);
  const copied = useSignal(false);
  const name = title === "" ? (language === "bash" ? "Command" : language) : title;
  const copy = (): void => {
    const { current } = lines;
    if (current !== null) getSelection()?.selectAllChildren(current);
    if (!window.isSecureContext) return; // Ctrl C copies the selection
    void navigator.clipboard.writeText(text).then(
      () => (copied.value = true),
      () => undefined,
    );
  };
  return (
    <div class={language === "text" ? "listing output" : "listing"}>
      {language !== "text" && (
        <div class="head">
          <span class="n" dir="auto">
            {name}
          </span>
          <span class="sp" />
          <span class="sm t2" role="status">
            {copied.value && "Copied"}
          </span>
          <Button icon="copy" label={title === "" ? "Copy" : `Copy ${title}`} small onClick={copy} />
        </div>
      )}
      <pre tabIndex={0} aria-label={language === "text" ? "Output" : name}>
        <code ref={lines}>{text}</code>
      </pre>
    </div>
  );
}
