/** Messages about the system itself: tf2_msgs, rosgraph_msgs, diagnostic_msgs, dynamic_reconfigure. */

import type { RosTime } from "../ros_types";
import type { TransformStamped } from "./geometry_msgs";
import type { Header } from "./std_msgs";

export type TFMessage = { readonly transforms: readonly TransformStamped[] };

export type Clock = { readonly clock: RosTime };

/** rosgraph_msgs/Log; level: 1 debug, 2 info, 4 warn, 8 error, 16 fatal. */
export type Log = {
  readonly header: Header;
  readonly level: number;
  readonly name: string;
  readonly msg: string;
  readonly file: string;
  readonly function: string;
  readonly line: number;
  readonly topics: readonly string[];
};

export type KeyValue = { readonly key: string; readonly value: string };

/** Level: 0 OK, 1 warn, 2 error, 3 stale. */
export type DiagnosticStatus = {
  readonly level: number;
  readonly name: string;
  readonly message: string;
  readonly hardware_id: string;
  readonly values: readonly KeyValue[];
};

export type DiagnosticArray = { readonly header: Header; readonly status: readonly DiagnosticStatus[] };

type Named<T> = { readonly name: string; readonly value: T };

/** dynamic_reconfigure/Config: the values of a node's parameters, by kind. */
export type Config = {
  readonly bools: readonly Named<boolean>[];
  readonly ints: readonly Named<number>[];
  readonly strs: readonly Named<string>[];
  readonly doubles: readonly Named<number>[];
  readonly groups: readonly {
    readonly name: string;
    readonly state: boolean;
    readonly id: number;
    readonly parent: number;
  }[];
};

export type ParamDescription = {
  readonly name: string;
  readonly type: string;
  readonly level: number;
  readonly description: string;
  /** Python literal of an enum, or empty. */
  readonly edit_method: string;
};

export type ConfigDescription = {
  readonly groups: readonly {
    readonly name: string;
    readonly type: string;
    readonly parameters: readonly ParamDescription[];
    readonly parent: number;
    readonly id: number;
  }[];
  readonly max: Config;
  readonly min: Config;
  readonly dflt: Config;
};
