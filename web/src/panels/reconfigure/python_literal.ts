/** Python literals, as dynamic_reconfigure writes the values of an enum into `edit_method`. */

export type Literal = string | number | boolean | null | readonly Literal[] | { readonly [key: string]: Literal };

/**
 * Read a literal of texts, numbers, True, False, None, lists, tuples and dicts; undefined: the text is no such literal.
 */
export function parseLiteral(text: string): Literal | undefined {
  try {
    const reader = new Reader(text);
    const value = reader.value();
    return reader.isAtEnd() ? value : undefined;
  } catch (error) {
    if (error instanceof SyntaxError || error instanceof RangeError) return undefined; // RangeError: nested too deeply
    throw error;
  }
}

const WORDS = new Map<string, Literal>([
  ["True", true],
  ["False", false],
  ["None", null],
]);
const ESCAPES: Readonly<Record<string, string>> = { n: "\n", t: "\t", r: "\r" };

class Reader {
  private at = 0;

  constructor(private readonly text: string) {}

  isAtEnd(): boolean {
    return this.peek() === "";
  }

  value(): Literal {
    const next = this.peek();
    if (next === "{") return this.dict();
    if (next === "[") return this.list("[", "]");
    if (next === "(") return this.list("(", ")");
    const prefixed = /^[uUbBrR]?(?=['"])/.exec(this.text.slice(this.at));
    if (prefixed !== null) {
      this.at += prefixed[0].length;
      return this.string();
    }
    const [word = ""] = /^[\w.+-]+/.exec(this.text.slice(this.at)) ?? [];
    this.at += word.length;
    const known = WORDS.get(word);
    if (known !== undefined) return known;
    const number = Number(word);
    if (word === "" || Number.isNaN(number)) throw new SyntaxError(word);
    return number;
  }

  private dict(): Literal {
    const entries: [string, Literal][] = [];
    this.expect("{");
    while (this.peek() !== "}") {
      const key = this.value();
      this.expect(":");
      if (typeof key === "object" && key !== null) throw new SyntaxError("a key");
      entries.push([String(key), this.value()]);
      if (this.peek() !== "}") this.expect(",");
    }
    this.expect("}");
    return Object.fromEntries(entries);
  }

  private list(open: string, close: string): Literal {
    const values: Literal[] = [];
    this.expect(open);
    while (this.peek() !== close) {
      values.push(this.value());
      if (this.peek() !== close) this.expect(",");
    }
    this.expect(close);
    return values;
  }

  private string(): string {
    const quote = this.text[this.at];
    let read = "";
    for (this.at += 1; this.text[this.at] !== quote; this.at += 1) {
      const letter = this.text[this.at];
      if (letter === undefined) throw new SyntaxError("an open text");
      if (letter === "\\") {
        this.at += 1;
        const escaped = this.text[this.at] ?? "";
        read += ESCAPES[escaped] ?? escaped;
      } else read += letter;
    }
    this.at += 1;
    return read;
  }

  private peek(): string {
    while (/\s/.test(this.text[this.at] ?? "")) this.at += 1;
    return this.text[this.at] ?? "";
  }

  private expect(letter: string): void {
    if (this.peek() !== letter) throw new SyntaxError(letter);
    this.at += 1;
  }
}
