/** An .rviz file: the page reads what it understands, and writes the rest back unchanged. */

import { parseDocument, type Document } from "yaml";

import { isMapping, type Yaml, type YamlMapping } from "./properties";
import { merge } from "./merge";

/** A file that is not one of rviz's; its message is a sentence. */
export class RvizFileError extends Error {}

/** Content of an .rviz file that the page understands. */
export interface RvizContent {
  readonly globalOptions: YamlMapping;
  readonly displays: readonly Yaml[];
  readonly views: YamlMapping;
  readonly tools: readonly YamlMapping[];
}

const MANAGER = "Visualization Manager";

export class RvizFile {
  private constructor(private readonly document: Document) {}

  static parse(text: string): RvizFile {
    if (isOldConfig(text)) {
      throw new RvizFileError(
        "This is a .vcg file of rviz before ROS Groovy, which is not read. Set the displays up here and save them as .rviz.",
      );
    }
    const [document, root] = readYaml(text);
    if (!isMapping(root) || !isMapping(root[MANAGER])) {
      throw new RvizFileError(`The file has no "${MANAGER}", which every .rviz file has.`);
    }
    return new RvizFile(document);
  }

  content(): RvizContent {
    const manager = child(this.document.toJS() as YamlMapping, MANAGER);
    return {
      globalOptions: child(manager, "Global Options"),
      displays: list(manager["Displays"]),
      views: rviz1(child(manager, "Views")) as YamlMapping,
      tools: list(manager["Tools"])
        .filter(isMapping)
        .map((tool) => rviz1(tool) as YamlMapping),
    };
  }

  /** The file's text with this content. */
  write(content: RvizContent): string {
    const { globalOptions, displays, views, tools } = content;
    const manager: YamlMapping = { Displays: displays, "Global Options": globalOptions, Tools: tools, Views: views };
    merge(this.document, this.document.contents, { [MANAGER]: manager });
    return this.document.toString({ lineWidth: 0, indentSeq: true, flowCollectionPadding: true });
  }
}

function readYaml(text: string): readonly [Document, Yaml] {
  try {
    const document = parseDocument(text, { uniqueKeys: false });
    const [error] = document.errors;
    if (error !== undefined) throw error;
    return [document, document.toJS() as Yaml];
  } catch (error) {
    // endless aliases or nesting, and aliases without an anchor, raise other errors
    throw new RvizFileError(`The .rviz file is not YAML: ${(error as Error).message.split("\n")[0] ?? ""}`);
  }
}

function child(mapping: YamlMapping, key: string): YamlMapping {
  const entry = mapping[key];
  return isMapping(entry) ? entry : {};
}

function list(yaml: Yaml | undefined): readonly Yaml[] {
  return Array.isArray(yaml) ? (yaml as readonly Yaml[]) : [];
}

/** Classes of ROS 2's views and tools by ROS 1's names. */
function rviz1(yaml: Yaml): Yaml {
  if (Array.isArray(yaml)) return (yaml as readonly Yaml[]).map(rviz1);
  if (!isMapping(yaml)) return yaml;
  const entries = Object.entries(yaml).map(([key, value]): [string, Yaml] => {
    if (key === "Class" && typeof value === "string")
      return [key, value.replace(/^rviz_(default_plugins|common)\//, "rviz/")];
    if (key === "Value" && typeof value === "string")
      return [key, value.replace(/\(rviz_default_plugins\)$/, "(rviz)")];
    return [key, rviz1(value)];
  });
  return Object.fromEntries(entries);
}

/** Before Groovy, rviz wrote Qt's settings: `Fixed\ Frame=/map` and sections `[Display0]`. */
function isOldConfig(text: string): boolean {
  return /^\[Display\d+\]/m.test(text) || /^[A-Za-z]+(\\ [A-Za-z]+)+=/m.test(text);
}

/** The content of a page that was started without a file. */
export const DEFAULT_FILE = `Panels:
  - Class: rviz/Displays
    Name: Displays
  - Class: rviz/Views
    Name: Views
Visualization Manager:
  Class: ""
  Displays:
    - Class: rviz/Grid
      Name: Grid
      Value: true
    - Class: rviz/RobotModel
      Name: RobotModel
      Value: true
    - Class: rviz/TF
      Name: TF
      Value: true
  Enabled: true
  Global Options:
    Background Color: 48; 48; 48
    Frame Rate: 30
  Name: root
  Tools: []
  Value: true
  Views: {}
`;
