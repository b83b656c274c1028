/** Messages between the page's server and its client, made by web/schema. */

import type { Json } from "../json";

/** First message to a client. */
export interface ServerInfo {
  readonly op: "serverInfo";
  readonly name: string;
  /** Operations that the client may use, by the protocol's names. */
  readonly capabilities: readonly string[];
  readonly supportedEncodings: readonly string[];
  readonly metadata: { readonly [name: string]: string };
  /** Distinguishes this server from an earlier one at the same address. */
  readonly sessionId: string;
}

/** Status of the server; replaces the earlier one with the same id. */
export interface Status {
  readonly op: "status";
  /** `INFO`, `WARNING` or `ERROR`. */
  readonly level: number;
  readonly message: string;
  readonly id?: string;
}

/** Ids of status messages that end. */
export interface RemoveStatus {
  readonly op: "removeStatus";
  readonly statusIds: readonly string[];
}

/** New channels. */
export interface AdvertiseChannels {
  readonly op: "advertise";
  readonly channels: readonly ChannelOffer[];
}

/** Channel that a client may subscribe to. */
export interface ChannelOffer {
  readonly id: number;
  readonly topic: string;
  readonly encoding: string;
  /** Type of its messages: `sensor_msgs/LaserScan`. */
  readonly schemaName: string;
  /** Full definition of the type. */
  readonly schema: string;
  readonly schemaEncoding?: string;
}

/** Ids of channels that end, with their subscriptions. */
export interface UnadvertiseChannels {
  readonly op: "unadvertise";
  readonly channelIds: readonly number[];
}

/** New services. */
export interface AdvertiseServices {
  readonly op: "advertiseServices";
  readonly services: readonly ServiceOffer[];
}

/** Service that a client may call, with its types in the protocol's newer and older form. */
export interface ServiceOffer {
  readonly id: number;
  readonly name: string;
  readonly type: string;
  readonly request: ServiceSchema;
  readonly response: ServiceSchema;
  readonly requestSchema: string;
  readonly responseSchema: string;
}

/** Type of a service's requests or responses. */
export interface ServiceSchema {
  readonly encoding: string;
  readonly schemaEncoding: string;
  readonly schemaName: string;
  readonly schema: string;
}

/** Ids of services that end. */
export interface UnadvertiseServices {
  readonly op: "unadvertiseServices";
  readonly serviceIds: readonly number[];
}

/** Service call that failed. */
export interface ServiceCallFailure {
  readonly op: "serviceCallFailure";
  readonly serviceId: number;
  readonly callId: number;
  readonly message: string;
}

/** Requested or changed parameters. */
export interface ParameterValues {
  readonly op: "parameterValues";
  readonly parameters: readonly Parameter[];
  /** Id of the answered request. */
  readonly id?: string;
}

/** Parameter and its value; unset: the parameter is deleted or not set. */
export interface Parameter {
  readonly name: string;
  readonly value?: Json;
  readonly type?: "byte_array" | "float64" | "float64_array" | null;
}

/** Topics and services whose nodes have changed. */
export interface ConnectionGraphUpdate {
  readonly op: "connectionGraphUpdate";
  readonly publishedTopics: readonly PublishedTopic[];
  readonly subscribedTopics: readonly SubscribedTopic[];
  readonly advertisedServices: readonly ProvidedService[];
  readonly removedTopics: readonly string[];
  readonly removedServices: readonly string[];
}

/** Current publishers of a topic. */
export interface PublishedTopic {
  readonly name: string;
  readonly publisherIds: readonly string[];
}

/** Current subscribers of a topic. */
export interface SubscribedTopic {
  readonly name: string;
  readonly subscriberIds: readonly string[];
  /** Datatype, `*` if unknown; an addition to the protocol, as a topic without a publisher has no channel. */
  readonly type: string;
}

/** Current providers of a service. */
export interface ProvidedService {
  readonly name: string;
  readonly providerIds: readonly string[];
}

/** Answer to a request of `trundle.v1`; if it is `ok`, the fields of its `Answer` follow. */
export interface Response {
  readonly op: "trundle/response";
  readonly id: number | string;
  readonly ok: boolean;
  /** Reason for a failure. */
  readonly error?: string;
}

/** Receipt of a velocity command. */
export interface DriveReceipt {
  readonly op: "trundle/driven";
  readonly number: number;
}

/** Session for a client, which reloads the page when `kind` or `version` changes. */
export interface PageSession {
  readonly title: string;
  readonly kind: "bag" | "graph" | "log" | "simulation";
  /** Robot's name, for the tab's title. */
  readonly robot: string | null;
  readonly rviz: RvizFile | null;
  readonly fixed_frame: string | null;
  /** Namespace of the rviz node, for relative names in its file, its tf and its parameters. */
  readonly namespace: string;
  /** Remappings of the rviz node: global name → global name. */
  readonly remappings: { readonly [name: string]: string };
  /** rqt's programs whose panels are open at the start: `rqt_graph`. */
  readonly panels: readonly string[];
  /** Curves of the plots panel: `/odom/pose/pose/position/x`. */
  readonly plots: readonly string[];
  /** Image topics to show. */
  readonly images: readonly string[];
  /** Topic of velocity commands; null: no driving. */
  readonly drive_topic: string | null;
  readonly sliders: readonly JointSlider[];
  /** true if a joystick is shown: the launch has started a joy node. */
  readonly joystick: boolean;
  readonly terminals: readonly NodeTerminal[];
  /** Lesson that is open at the start: the name of one that Trundle brings, or a path FILE.md. */
  readonly lesson: string | null;
  /** Version of the server. */
  readonly version: string;
  /** Address for Foxglove and Lichtblick. */
  readonly foxglove: string;
  /** Name of the page's node on the graph; null: no graph, or not joined yet. */
  readonly node: string | null;
  /** true if this client must not change anything. */
  readonly view_only: boolean;
  /** Token of links with full access; null: this client is view-only. */
  readonly token: string | null;
  /** Token of view-only links. */
  readonly view_token: string;
  /** URLs of the page for other machines, without a path; empty: the page listens on loopback only. */
  readonly network_urls: readonly string[];
}

/** The .rviz file that the page was started with, or that was saved last. */
export interface RvizFile {
  readonly name: string;
  readonly text: string;
  /** true if the file may be replaced. */
  readonly writable: boolean;
  /** true if the page saved it: `name` is its path from the working folder, and `SaveRvizAs` replaces it. */
  readonly saved: boolean;
}

/** Joint of joint_state_publisher_gui. */
export interface JointSlider {
  readonly name: string;
  /** [rad or m] */
  readonly lower: number;
  /** [rad or m] */
  readonly upper: number;
  /** [rad or m] */
  readonly position: number;
}

/** Terminal of a node; its channel is `trundle/terminal/N` with its index in the list. */
export interface NodeTerminal {
  /** Node's name. */
  readonly name: string;
  /** Message about the node's end; null: it runs. */
  readonly ended: string | null;
}

/** Simulated world; generation, file, files, draft and reference are set later. */
export interface Manifest {
  /** Number that is also in the headers of this world's poses, joints and contacts. */
  readonly generation: number;
  readonly name: string;
  /** Path to offer for saving the world; null: not writable. */
  readonly file: string | null;
  /** Files of the lights and of the models, in the order of the models. */
  readonly files: readonly FileUrl[];
  /** URL of a GLB. */
  readonly collisions: string | null;
  /** URLs of the meshes and images that these files refer to. */
  readonly resources: readonly string[];
  readonly scene: SceneSettings;
  readonly physics: PhysicsSettings;
  /** Body number of the robot, on which the view centres first. */
  readonly robot: number | null;
  readonly models: readonly ModelInfo[];
  /** Plugins of the world itself. */
  readonly plugins: readonly PluginInfo[];
  readonly lights: readonly LightInfo[];
  readonly cameras: readonly CameraInfo[];
  readonly frames: readonly FrameInfo[];
  /** Copy of a model that is being edited, shown in place of the original. */
  readonly draft: DraftInfo | null;
  /** Recording that the world is compared with. */
  readonly reference: ReferenceInfo | null;
}

/** GLB file. */
export interface FileUrl {
  /** Model's name; `draft`; or empty for the lights of the world itself. */
  readonly id: string;
  readonly url: string;
}

/** Light, background, sky and fog of a world; colors 0 to 1. */
export interface SceneSettings {
  readonly ambient: readonly [number, number, number];
  readonly background: readonly [number, number, number];
  readonly sky: boolean;
  readonly shadows: boolean;
  readonly grid: boolean;
  readonly fog: Fog | null;
}

/** Fog, as in SDF. */
export interface Fog {
  readonly type: string;
  readonly color: readonly [number, number, number];
  /** [m] */
  readonly start: number;
  /** [m] */
  readonly end: number;
  readonly density: number;
}

/** Editable settings of the physics. */
export interface PhysicsSettings {
  /** [m/s²] */
  readonly gravity: readonly [number, number, number];
  /** [m/s] */
  readonly wind: readonly [number, number, number];
  /** Time step [s]. */
  readonly step: number;
}

/** Model, with nested models. */
export interface ModelInfo {
  readonly name: string;
  readonly static: boolean;
  /** true if the model is held: its base is fixed to the world. */
  readonly held: boolean;
  /** `file:line` */
  readonly source: string | null;
  readonly links: readonly LinkInfo[];
  readonly joints: readonly JointInfo[];
  readonly plugins: readonly PluginInfo[];
  readonly models: readonly ModelInfo[];
}

/** Link. */
export interface LinkInfo {
  readonly name: string;
  /** Body number: row in `trundle/poses`. */
  readonly body: number;
  /** [kg] */
  readonly mass: number;
  readonly inertia: readonly [number, number, number, number, number, number];
  readonly inertial_pose: readonly [number, number, number, number, number, number];
  /** mu and mu2; null: no collisions. */
  readonly friction: readonly [number, number] | null;
  /** `file:line` */
  readonly source: string | null;
  readonly sensors: readonly SensorInfo[];
}

/** Sensor of a link, or of its parent joint. */
export interface SensorInfo {
  readonly name: string;
  readonly type: string;
  /** [Hz] */
  readonly rate: number;
  readonly topic: string | null;
  /** Values of its readings that can be plotted: `angular_velocity.z`. */
  readonly series: readonly string[];
  /** `file:line` */
  readonly source: string | null;
  readonly plugins: readonly PluginInfo[];
}

/** Plugin, as in its file. */
export interface PluginInfo {
  /** Name, with a number for the second plugin of the same name. */
  readonly name: string;
  readonly filename: string;
  /** `file:line` */
  readonly source: string | null;
  /** Path in the plugin's element (`noise/stddev`) and text. */
  readonly parameters: readonly (readonly [string, string])[];
}

/** Joint. */
export interface JointInfo {
  readonly name: string;
  readonly type: string;
  readonly parent: string;
  readonly child: string;
  /** [rad or m]; null: no limit. */
  readonly lower: number | null;
  /** [rad or m]; null: no limit. */
  readonly upper: number | null;
  /** Pose of the joint's frame in the child's. */
  readonly pose: readonly [number, number, number, number, number, number];
  /** Directions in the child's frame. */
  readonly axes: readonly (readonly [number, number, number])[];
  /** Row in `trundle/joints`; null: no single axis. */
  readonly index: number | null;
  /** `file:line` */
  readonly source: string | null;
}

/** Light of the world, or of a link (then named `model::link::light`). */
export interface LightInfo {
  readonly name: string;
  readonly type: string;
  /** Body in whose frame the pose is; null: the world frame. */
  readonly body: number | null;
  readonly pose: readonly [number, number, number, number, number, number];
  /** Direction in the light's frame. */
  readonly direction: readonly [number, number, number];
  /** Color, 0 to 1. */
  readonly diffuse: readonly [number, number, number];
  readonly intensity: number;
}

/** Camera. */
export interface CameraInfo {
  readonly name: string;
  readonly topic: string;
  /** Body in whose frame the pose is. */
  readonly body: number;
  readonly pose: readonly [number, number, number, number, number, number];
  /** [rad] */
  readonly horizontal_fov: number;
  /** [px] */
  readonly width: number;
  /** [px] */
  readonly height: number;
  /** Near clipping distance [m]. */
  readonly near: number;
  /** Far clipping distance [m]. */
  readonly far: number;
  /** [Hz] */
  readonly rate: number;
}

/** tf frame that moves with a body. */
export interface FrameInfo {
  readonly frame: string;
  readonly parent: string;
  readonly body: number;
}

/** Model being edited. */
export interface DraftInfo {
  readonly name: string;
  /** Model of the world that it replaces; null: a new model. */
  readonly original: string | null;
  /** x y z [m], roll pitch yaw [rad] of the model in the world. */
  readonly pose: readonly [number, number, number, number, number, number];
  /** Title of the edit to undo. */
  readonly undo: string | null;
  /** Title of the edit to redo. */
  readonly redo: string | null;
  /** Folder to offer for saving; null: not writable. */
  readonly folder: string | null;
  readonly files: readonly FileUrl[];
  /** The model itself, then its parts in file order. */
  readonly parts: readonly DraftPart[];
}

/** Element of the model. */
export interface DraftPart {
  /** Address by tags and names: ("link", "base", "sensor", "eye"); empty: the model itself. */
  readonly part: readonly string[];
  readonly tag: string;
  readonly name: string;
  /** Type, shape or file name. */
  readonly detail: string;
  /** [kg]; null: not a link. */
  readonly mass: number | null;
  /** Index of a link; null: not a link. */
  readonly link: number | null;
  readonly line: number;
  readonly sections: readonly DraftSection[];
  readonly findings: readonly DraftFinding[];
}

/** Fields under one heading. */
export interface DraftSection {
  readonly title: string;
  readonly fields: readonly DraftField[];
}

/** Value of a part. */
export interface DraftField {
  /** Path of an element, `inertial/mass`, or of an attribute, `axis/@name`. */
  readonly name: string;
  readonly label: string;
  readonly kind: "choice" | "color" | "flag" | "number" | "pose" | "text" | "vector";
  readonly value: string | readonly number[] | boolean | null;
  readonly default: string | readonly number[] | boolean | null;
  readonly unit?: string;
  /** Names of a vector's components. */
  readonly labels?: readonly string[];
  readonly choices?: readonly string[];
  readonly minimum?: number;
  readonly maximum?: number;
}

/** Error or warning about a part. */
export interface DraftFinding {
  /** `error` or `warning`. */
  readonly severity: string;
  readonly text: string;
  /** Line of the draft's text. */
  readonly line: number | null;
}

/** Recording that the world or the topics are compared with. */
export interface ReferenceInfo {
  readonly title: string;
  /**
   * URL of its samples, little-endian: times since its start (samples) f64 [s], positions of the joints
   * (samples, joints) f64 [rad or m], of each topic times (its samples) f64 and numbers (its samples, paths) f64, poses
   * of the links (samples, links, 7) f32: x y z [m], quaternion x y z w.
   */
  readonly url: string;
  /** Time of the world at which it starts [s], with the offset. */
  readonly start: number;
  /** Time by which it starts after the run [s]. */
  readonly offset: number;
  /** [s] */
  readonly duration: number;
  readonly samples: number;
  /** `model::link`, of the models that are compared; of a bag, names of frames. */
  readonly links: readonly string[];
  /** `model::joint` */
  readonly joints: readonly string[];
  readonly topics: readonly ReferenceTopic[];
  /** Frame of the poses of a bag; empty: the world. */
  readonly root: string;
}

/** Numbers of a bag's topic, of messages with the same lengths and names of arrays. */
export interface ReferenceTopic {
  readonly topic: string;
  readonly samples: number;
  /** `.pose.pose.position.x`, `.position[left_wheel]` */
  readonly paths: readonly string[];
}

/** Clock and its controls. */
export interface ClockState {
  readonly time_ns: number;
  readonly paused: boolean;
  /** Null: unknown, or paused. */
  readonly real_time_factor: number | null;
  /** Requested multiple of real time; null: as fast as possible. */
  readonly speed: number | null;
  /** Unset: no recorded run. */
  readonly timeline?: TimelineSpan;
  /** Unset: the run cannot be recorded; null: it is not being recorded. */
  readonly recording?: Recording | null;
}

/** Extent of a recorded run. */
export interface TimelineSpan {
  readonly start_ns: number;
  readonly end_ns: number;
}

/** Running recording. */
export interface Recording {
  readonly since_ns: number;
}

/** Wall times of an interval, with counts. */
export interface Profile {
  readonly wall_s: number;
  readonly simulated_s: number;
  readonly steps: number;
  /** Number of contacts in the last step. */
  readonly contacts: number;
  /** Number of links of all models. */
  readonly bodies: number;
  /** Number of resting trees of bodies, which the physics skips. */
  readonly asleep: number;
  /** Processor time of the graph's thread, which runs in parallel; null: unknown, or without ROS. */
  readonly graph_s: number | null;
  /** Parts, the most expensive first; their times add up to the interval. */
  readonly parts: readonly ProfilePart[];
}

/** Wall time of one part. */
export interface ProfilePart {
  readonly group: "cameras" | "other" | "page" | "physics" | "plugins" | "ros" | "sensors" | "waiting";
  readonly name: string;
  readonly wall_s: number;
}

/** Differences of the world from the recording that it is compared with. */
export interface Differences {
  /** [s] */
  readonly time: number;
  /**
   * Models or frames, the farthest first, each by distance and angle, of recorded runs also by velocities; then
   * joints or numbers, the largest first.
   */
  readonly rows: readonly Difference[];
}

/** Difference of one value between a run and its reference: now, and over the time that both have had so far. */
export interface Difference {
  /** Model, `model::joint`, a frame in its parent, or the path of a message's number. */
  readonly name: string;
  /**
   * Distance [m] and angle [rad] between poses, difference of velocities [m/s] or angular velocities [rad/s], of a
   * joint's position [rad or m], or of a number.
   */
  readonly quantity: "angle" | "angular velocity" | "distance" | "position" | "value" | "velocity";
  /** Null: the reference has no such time, or the run no such model. */
  readonly now: number | null;
  /** Null: there was no time that both have. */
  readonly maximum: number | null;
  /** The run's time at the maximum [s]. */
  readonly maximum_time: number | null;
  /** Root mean square. */
  readonly rms: number | null;
}

/** Users of the page. */
export interface People {
  /** Number of the recipient. */
  readonly you: number;
  readonly people: readonly Person[];
}

/** A client that subscribes to the channel. */
export interface Person {
  /** Number from 1; numbers of users who have left are reused. */
  readonly number: number;
  readonly view_only: boolean;
  readonly selection: SelectedModel | SelectedLink | SelectedJoint | SelectedLight | null;
}

/** Model of the simulated world. */
export interface SelectedModel {
  readonly kind: "model";
  readonly model: string;
}

/** Link of a model. */
export interface SelectedLink {
  readonly kind: "link";
  readonly model: string;
  readonly link: string;
}

/** Joint of a model. */
export interface SelectedJoint {
  readonly kind: "joint";
  readonly model: string;
  readonly joint: string;
}

/** Light of the world. */
export interface SelectedLight {
  readonly kind: "light";
  readonly light: string;
}

/** Content of the channel. */
export interface Lanes {
  readonly start_ns: number;
  readonly bucket_ns: number;
  readonly topics: { readonly [name: string]: Lane };
}

/** A topic's messages over time. */
export interface Lane {
  readonly count: number;
  /** First and last bucket of each run of nonempty buckets. */
  readonly bands: readonly (readonly [number, number])[];
}

/** Columns of plotted values, after the time. */
export interface SeriesHead {
  readonly names: readonly string[];
  readonly units: readonly string[];
  /** Name → reason why it has no values. */
  readonly faults: { readonly [name: string]: string };
}

/** Answer to an upload. */
export interface UploadedModels {
  /** Names of the models that can now be inserted. */
  readonly models: readonly string[];
}

/** Answer to an upload of a recording: the page is compared with it. */
export interface UploadedRecording {
  readonly title: string;
}

/** Metadata of the recording in a replay's file. */
export interface ReplayAbout {
  readonly title: string;
  /** Simulated time [s]. */
  readonly start: number;
  /** Simulated time [s]. */
  readonly end: number;
  readonly scene: SceneSettings;
  /** Initial view, as in an .rviz file; null: everything that moves is in view. */
  readonly view: { readonly [name: string]: Json } | null;
}

/** The request was executed. */
export type Done = { readonly [name: string]: never };

/** A world was written. */
export interface SavedWorld {
  /** Path as requested. */
  readonly file: string;
  /** Parts of the world that are not in the file. */
  readonly lost: readonly string[];
}

/** A world as SDF. */
export interface WorldText {
  readonly sdf: string;
  /** Parts of the world that are not in the text. */
  readonly lost: readonly string[];
}

/** Nothing was written: there are files that must not be replaced. */
export interface FilesExist {
  /** Their names, separated by commas. */
  readonly exists: string;
}

/** A replay as a page that needs no server. */
export interface ReplayPage {
  readonly html: string;
}

/** A replay as an animated scene. */
export interface ReplayScene {
  /** Base64 of a GLB. */
  readonly glb: string;
}

/** Models that can be inserted, uploaded ones first. */
export interface ModelList {
  readonly models: readonly ModelEntry[];
}

/** Model that can be inserted. */
export interface ModelEntry {
  /** Folder's name. */
  readonly name: string;
  readonly title: string;
  readonly description: string;
  readonly uploaded: boolean;
}

/** A model or light was inserted into the world. */
export interface Inserted {
  /** Name in the world. */
  readonly name: string;
}

/** Nothing was inserted: the user must first consent to run the model's code. */
export interface CodeQuestion {
  /** Files of code. */
  readonly code: readonly string[];
  /** Token that gives consent to this code once. */
  readonly consent: string;
}

/** Parts that can be added to a draft. */
export interface DraftOffers {
  readonly plugins: readonly PluginOffer[];
  /** Types. */
  readonly sensors: readonly string[];
  /** Types. */
  readonly joints: readonly string[];
  /** URIs. */
  readonly meshes: readonly string[];
}

/** Plugin that can be added to a draft. */
export interface PluginOffer {
  readonly filename: string;
  /** Summary of its documentation. */
  readonly about: string;
}

/** The draft was edited. */
export interface EditedPart {
  /** Address of the part after the edit; empty: the model itself. */
  readonly part: readonly string[];
}

/** A file, or a folder with files, was written. */
export interface SavedFile {
  /** Path as requested. */
  readonly file: string;
}

/** Definition of a message type. */
export interface DefinitionText {
  /** Definition with those of all nested types. */
  readonly definition: string;
}

/** Lessons that can be opened; the one that the page was started with is the first. */
export interface LessonList {
  readonly lessons: readonly LessonEntry[];
}

/** Lesson that can be opened. */
export interface LessonEntry {
  readonly name: string;
  readonly title: string;
}

/** A lesson. */
export interface OpenedLesson {
  readonly lesson: Lesson;
}

/** Lesson. */
export interface Lesson {
  readonly title: string;
  /** Command that starts the lesson's world and nodes; empty: the lesson needs none. */
  readonly start: string;
  /** Alternative checks: one of them is fulfilled once that command runs. */
  readonly needs: readonly StatedCheck[];
  readonly steps: readonly LessonStep[];
}

/** Check with its sentence. */
export interface StatedCheck {
  readonly sentence: string;
  readonly check:
    | FileCheck
    | ModelCheck
    | RobotCheck
    | SelectedCheck
    | MovedCheck
    | FrameMovedCheck
    | JointMovedCheck
    | NodeCheck
    | PublishesCheck
    | SubscribesCheck
    | RateCheck
    | FixedFrameCheck;
}

/** A file exists, and can be read if it is a description, launch file, program or configuration. */
export interface FileCheck {
  readonly check: "file";
  /** Path from the working folder; `~` is the home folder. */
  readonly path: string;
}

/** A model is in the world. */
export interface ModelCheck {
  readonly check: "model";
  readonly model: string;
}

/** The page shows a robot. */
export interface RobotCheck {
  readonly check: "robot";
  readonly name: string;
}

/** A model, or a part of it, is selected. */
export interface SelectedCheck {
  readonly check: "selected";
  readonly model: string;
}

/** A model has moved since the step began. */
export interface MovedCheck {
  readonly check: "moved";
  readonly model: string;
  /** [m] */
  readonly distance: number;
}

/** A frame of tf has moved since the step began. */
export interface FrameMovedCheck {
  readonly check: "frame_moved";
  readonly frame: string;
  /** Frame in which the position is measured. */
  readonly reference: string;
  /** [m] */
  readonly distance: number;
}

/** A joint has moved since the step began. */
export interface JointMovedCheck {
  readonly check: "joint_moved";
  readonly model: string;
  readonly joint: string;
  /** [rad or m] */
  readonly by: number;
}

/** A node is on the graph. */
export interface NodeCheck {
  readonly check: "node";
  readonly node: string;
}

/** A node other than the page publishes on a topic. */
export interface PublishesCheck {
  readonly check: "publishes";
  readonly topic: string;
}

/** A node other than the page subscribes to a topic. */
export interface SubscribesCheck {
  readonly check: "subscribes";
  readonly topic: string;
}

/** Messages of a topic arrive at a rate. */
export interface RateCheck {
  readonly check: "rate";
  readonly topic: string;
  /** Minimum rate [Hz]. */
  readonly hz: number;
}

/** The displays use a fixed frame. */
export interface FixedFrameCheck {
  readonly check: "fixed_frame";
  readonly frame: string;
}

/** Step of a lesson. */
export interface LessonStep {
  readonly title: string;
  readonly blocks: readonly (Paragraph | Heading | ItemList | Quotation | CodeBlock)[];
  /** Checks that are all fulfilled when the step is done; empty: the step is only read. */
  readonly checks: readonly StatedCheck[];
  /** Parts of the page that are marked. */
  readonly parts: readonly (
    | "cameras"
    | "clock"
    | "compare"
    | "displays"
    | "drive"
    | "graph"
    | "images"
    | "insert"
    | "inspector"
    | "joints"
    | "joystick"
    | "log"
    | "motion_planning"
    | "navigation"
    | "nodes"
    | "parameters"
    | "performance"
    | "play"
    | "plots"
    | "reconfigure"
    | "reset"
    | "services"
    | "steering"
    | "terminal"
    | "tf_tree"
    | "timeline"
    | "tools"
    | "topics"
    | "views"
    | "world"
  )[];
  /** Models that are outlined in the scene. */
  readonly models: readonly string[];
}

/** Paragraph. */
export interface Paragraph {
  readonly kind: "paragraph";
  readonly content: readonly (PlainText | CodeSpan | LineBreak | Emphasis | WebLink)[];
}

/** Text. */
export interface PlainText {
  readonly kind: "text";
  readonly text: string;
}

/** Code within a sentence. */
export interface CodeSpan {
  readonly kind: "code";
  readonly text: string;
}

/** Line break. */
export interface LineBreak {
  readonly kind: "break";
}

/** Emphasized text. */
export interface Emphasis {
  readonly kind: "emphasis";
  readonly strong: boolean;
  readonly content: readonly (PlainText | CodeSpan | LineBreak | Emphasis | WebLink)[];
}

/** Link to a page of the Web. */
export interface WebLink {
  readonly kind: "link";
  /** Address with the scheme http or https. */
  readonly url: string;
  readonly content: readonly (PlainText | CodeSpan | LineBreak | Emphasis | WebLink)[];
}

/** Heading within a step. */
export interface Heading {
  readonly kind: "heading";
  readonly content: readonly (PlainText | CodeSpan | LineBreak | Emphasis | WebLink)[];
}

/** List. */
export interface ItemList {
  readonly kind: "list";
  readonly ordered: boolean;
  /** Number of the first item of an ordered list. */
  readonly first: number;
  readonly items: readonly (readonly (Paragraph | Heading | ItemList | Quotation | CodeBlock)[])[];
}

/** Quoted blocks. */
export interface Quotation {
  readonly kind: "quotation";
  readonly blocks: readonly (Paragraph | Heading | ItemList | Quotation | CodeBlock)[];
}

/** Lines of code, commands or output. */
export interface CodeBlock {
  readonly kind: "code_block";
  /** Language, as `bash`; `text` is output. */
  readonly language: string;
  /** Name of the file with this content; empty: none. */
  readonly title: string;
  readonly text: string;
}

/** State of a file that a lesson names. */
export interface FileState {
  /** Reason why the file does not load; null: it exists and loads. */
  readonly fault: string | null;
}

/** Run the simulation or recording. */
export type Play = { readonly [name: string]: never };

/** Pause the simulation or recording. */
export type Pause = { readonly [name: string]: never };

/** Pause, then do physics steps. */
export interface Step {
  readonly count?: number;
}

/** Pause, then do physics steps up to a time in the future. */
export interface RunTo {
  readonly time_ns: number;
}

/** Reset time, poses or both to their initial state. */
export interface Reset {
  readonly what?: "all" | "poses" | "time";
}

/** Reload the world. */
export type Reload = { readonly [name: string]: never };

/** Set the speed as a multiple of real time; null: as fast as possible. */
export interface SetSpeed {
  readonly factor: number | null;
}

/** Set the time of a recorded run or bag. */
export interface Seek {
  readonly time_ns: number;
}

/** Command a joint by exactly one of position, velocity and effort. */
export interface MoveJoint {
  readonly model: string;
  readonly joint: string;
  /** [rad or m] */
  readonly position?: number | null;
  /** [rad/s or m/s] */
  readonly velocity?: number | null;
  /** [N·m or N] */
  readonly effort?: number | null;
}

/** Set the position of a joint at once; its velocity and motor commands stay. */
export interface PlaceJoint {
  readonly model: string;
  readonly joint: string;
  /** [rad or m] */
  readonly position: number;
}

/** Move a model so that one of its links has this pose. */
export interface SetPose {
  readonly model: string;
  readonly link: string;
  /** In the world [m]. */
  readonly position: readonly [number, number, number];
  /** Quaternion wxyz of any length except zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Keep a model at rest with one of its links at this pose, until `let_go` or a second without such a request. */
export interface Carry {
  readonly model: string;
  readonly link: string;
  /** In the world [m]. */
  readonly position: readonly [number, number, number];
  /** Quaternion wxyz of any length except zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Pull a point of a link to a target by a spring, until `let_go` or a second without such a request. */
export interface Pull {
  readonly model: string;
  readonly link: string;
  /** In the link's frame [m]. */
  readonly point: readonly [number, number, number];
  /** In the world [m]. */
  readonly target: readonly [number, number, number];
}

/** Stop carrying or pulling a model. */
export interface LetGo {
  readonly model: string;
}

/** Fix a model's base at its current pose, even in the air, or free it again. */
export interface HoldModel {
  readonly model: string;
  readonly on: boolean;
}

/** Set the velocity of a model once, in world axes. */
export interface SetTwist {
  readonly model: string;
  /** [m/s] */
  readonly linear: readonly [number, number, number];
  /** [rad/s] */
  readonly angular: readonly [number, number, number];
}

/** Set the mass of a link and scale its moments of inertia. */
export interface SetMass {
  readonly model: string;
  readonly link: string;
  /** [kg] */
  readonly mass: number;
}

/** Set the friction of all collisions of a link. */
export interface SetFriction {
  readonly model: string;
  readonly link: string;
  readonly mu: number;
  readonly mu2: number;
}

/** Set the color and intensity of a light. */
export interface SetLight {
  /** `name`, or `model::link::name` for a link's light. */
  readonly light: string;
  readonly diffuse: readonly [number, number, number];
  readonly intensity: number;
}

/** Move a light that belongs to the world, not to a link. */
export interface PlaceLight {
  readonly light: string;
  /** In the world [m]. */
  readonly position: readonly [number, number, number];
  /** Quaternion wxyz of any length except zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Set gravity, wind or time step; null: unchanged. */
export interface SetPhysics {
  /** [m/s²] */
  readonly gravity?: readonly [number, number, number] | null;
  /** [m/s] */
  readonly wind?: readonly [number, number, number] | null;
  /** [s] */
  readonly step?: number | null;
}

/** Apply a wrench to a link at its centre of mass, in world axes. */
export interface ApplyWrench {
  readonly model: string;
  readonly link: string;
  /** [N] */
  readonly force: readonly [number, number, number];
  /** [N·m] */
  readonly torque: readonly [number, number, number];
  /** Simulated time [s]. */
  readonly duration: number;
}

/** Write the world as SDF. */
export interface SaveWorld {
  /** Path below the folder where the simulation was started; null: answer with the SDF text. */
  readonly file: string | null;
  /** true if the user has confirmed to replace the file. */
  readonly replace?: boolean;
}

/** Make a replay of the last minutes. */
export interface SaveReplay {
  /** Initial view of the replay page: JSON of a view as in an .rviz file. */
  readonly view?: string | null;
  readonly format?: "glb" | "html";
}

/** List the models that can be inserted. */
export type ListModels = { readonly [name: string]: never };

/** Insert a model of the model path or a simple shape; a model with code needs the user's consent. */
export interface InsertModel {
  /** Name of the model's folder; if `is_shape`: `box`, `sphere` or `cylinder`. */
  readonly model: string;
  /** Point on the floor [m]. */
  readonly position: readonly [number, number, number];
  readonly is_shape?: boolean;
  /** Token of the `CodeQuestion` to which the user has consented. */
  readonly consent?: string | null;
}

/** Insert a light above a point. */
export interface InsertLight {
  readonly type: "directional" | "point" | "spot";
  /** Point on the floor [m]. */
  readonly position: readonly [number, number, number];
}

/** Add a copy of a model in its current state, with its sensors and plugins. */
export interface CopyModel {
  readonly model: string;
  /** Name of the copy. */
  readonly name: string;
  /** Offset of the copy from the model, in the world [m]. */
  readonly offset: readonly [number, number, number];
}

/** Remove a model from the world, with its sensors and plugins. */
export interface DeleteModel {
  readonly model: string;
}

/** Restore a model that the page deleted, in its former state, with its sensors and plugins. */
export interface RestoreModel {
  readonly model: string;
}

/** Reset a model to its initial pose and joint positions, at rest, with motors off; its plugins are reset, too. */
export interface ResetModel {
  readonly model: string;
}

/** Restore a model's state before its latest reset, with motors, wrenches and the state of its plugins. */
export interface UndoReset {
  readonly model: string;
}

/** Remove a light of the world. */
export interface DeleteLight {
  readonly light: string;
}

/** Restore a light that the page deleted. */
export interface RestoreLight {
  readonly light: string;
}

/** Start a draft from a model of the world or from nothing; the simulation pauses until the draft is left. */
export interface BeginDraft {
  /** Null: a new model. */
  readonly model: string | null;
  /** Position of a new model [m]. */
  readonly position?: readonly [number, number, number];
}

/** List the plugins, sensors, joints and meshes that can be added to a draft. */
export type ListOffers = { readonly [name: string]: never };

/** Set one value of a part. */
export interface SetField {
  readonly part: readonly string[];
  readonly field: string;
  readonly value: string | readonly (number | null)[] | null;
}

/** Move a link, or the model as a whole, to a pose in the world. */
export interface PlaceLink {
  readonly part: readonly string[];
  /** [m] */
  readonly position: readonly [number, number, number];
  /** Quaternion wxyz of any length except zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Add a part. */
export interface AddPart {
  /** Part that it is added to; for a joint, its child. */
  readonly into: readonly string[];
  readonly kind: "collision" | "joint" | "link" | "plugin" | "sensor" | "visual";
  /** Shape or URI of a mesh, type of the joint or sensor, file name of the plugin. */
  readonly type: string;
}

/** Add a copy of a part. */
export interface CopyPart {
  readonly part: readonly string[];
}

/** Remove a part, and the joints of a link. */
export interface RemovePart {
  readonly part: readonly string[];
}

/** Undo the latest edit of the draft. */
export type UndoDraft = { readonly [name: string]: never };

/** Redo the edit undone last. */
export type RedoDraft = { readonly [name: string]: never };

/** Write model.sdf and model.config. */
export interface SaveDraft {
  /** Path below the folder where the simulation was started. */
  readonly folder: string;
  /** true if the user has confirmed to replace the files. */
  readonly replace?: boolean;
}

/**
 * Insert the draft into the world, replacing its original.
 *
 * A model with code needs the user's consent.
 */
export interface FinishDraft {
  /** Token of the `CodeQuestion` to which the user has consented. */
  readonly consent?: string | null;
}

/** Discard the draft. */
export type LeaveDraft = { readonly [name: string]: never };

/** Move a joint of joint_state_publisher_gui. */
export interface MoveSlider {
  readonly joint: string;
  /** [rad or m] */
  readonly position: number;
}

/** Set a joystick's axes, −1 to 1, and buttons, 0 or 1, in joy's order; renewed within a second, else it rests. */
export interface MoveJoystick {
  readonly axes: readonly number[];
  readonly buttons: readonly (0 | 1)[];
}

/** Replace the .rviz file that the page was started with. */
export interface SaveRviz {
  readonly text: string;
}

/** Start or stop recording. */
export interface Record {
  readonly on: boolean;
}

/** Set the time by which the recording that the world is compared with starts after the run. */
export interface SetReferenceOffset {
  /** [s] */
  readonly offset: number;
}

/** Stop comparing the world with a recording. */
export type StopComparing = { readonly [name: string]: never };

/** Request the definition of a message type; the server answers this itself. */
export interface Definition {
  readonly type: string;
}

/** Set the values of the simulation that are sampled for `trundle/series`; the server answers this itself. */
export interface PlotSeries {
  /** Names such as `rp2w::chassis.pose.x`. */
  readonly series: readonly string[];
}

/** Save an .rviz file below the folder where Trundle was started; the server executes this itself. */
export interface SaveRvizAs {
  readonly file: string;
  readonly text: string;
  /** true: replace an existing file. */
  readonly replace?: boolean;
}

/** List the lessons. */
export type ListLessons = { readonly [name: string]: never };

/** Read a lesson. */
export interface OpenLesson {
  readonly name: string;
}

/** Check a file that a lesson names. */
export interface CheckLessonFile {
  readonly lesson: string;
  /** Index of the step. */
  readonly step: number;
  /** Index of the check in the step. */
  readonly check: number;
}

/**
 * Draw the scene with Trundle's renderer, for browsers without WebGL; answered by `PageServer.respond_picture`.
 *
 * The camera orbits the robot or the origin: at a distance, by azimuth about z and elevation.
 */
export interface RenderView {
  /** [px] */
  readonly width: number;
  /** [px] */
  readonly height: number;
  /** [rad] */
  readonly azimuth?: number;
  /** [rad] */
  readonly elevation?: number;
  /** [m] */
  readonly distance?: number;
}

/** Draw a model of the model path; answered by `PageServer.respond_picture`. */
export interface RenderModel {
  readonly model: string;
  /** PNG, or GLB for the preview at the pointer. */
  readonly kind?: "picture" | "shape";
}

/** Subscribe to channels. */
export interface Subscribe {
  readonly op: "subscribe";
  readonly subscriptions: readonly Subscription[];
}

/** Channel that a client subscribes to, with the subscription's id. */
export interface Subscription {
  readonly id: number;
  readonly channelId: number;
}

/** End subscriptions. */
export interface Unsubscribe {
  readonly op: "unsubscribe";
  readonly subscriptionIds: readonly number[];
}

/** Advertise topics that the client publishes to. */
export interface Advertise {
  readonly op: "advertise";
  readonly channels: readonly ClientChannel[];
}

/** Topic that a client publishes to. */
export interface ClientChannel {
  readonly id: number;
  readonly topic: string;
  readonly encoding: string;
  readonly schemaName: string;
  readonly schema?: string | null;
}

/** Stop publishing to topics. */
export interface Unadvertise {
  readonly op: "unadvertise";
  readonly channelIds: readonly number[];
}

/** Request parameters; no names: all. */
export interface GetParameters {
  readonly op: "getParameters";
  readonly parameterNames: readonly string[];
  readonly id?: string | null;
}

/** Set or delete parameters. */
export interface SetParameters {
  readonly op: "setParameters";
  readonly parameters: readonly Parameter[];
  readonly id?: string | null;
}

/** Subscribe to changes of parameters; no names: of all. */
export interface SubscribeParameterUpdates {
  readonly op: "subscribeParameterUpdates";
  readonly parameterNames: readonly string[];
}

/** Unsubscribe from changes of parameters; no names: from all. */
export interface UnsubscribeParameterUpdates {
  readonly op: "unsubscribeParameterUpdates";
  readonly parameterNames: readonly string[];
}

/** Subscribe to the nodes of topics and services. */
export interface SubscribeConnectionGraph {
  readonly op: "subscribeConnectionGraph";
}

/** Unsubscribe from the nodes of topics and services. */
export interface UnsubscribeConnectionGraph {
  readonly op: "unsubscribeConnectionGraph";
}

/** Request a file. */
export interface FetchAsset {
  readonly op: "fetchAsset";
  readonly uri: string;
  readonly requestId: number;
}

/** Drive at a velocity, which the server repeats at 10 Hz until the lease of the latest such message ends. */
export interface Drive {
  readonly op: "trundle/drive";
  readonly topic: string;
  /** Forward [m/s]. */
  readonly linear: number;
  /** To the left [rad/s]. */
  readonly angular: number;
  /** Time from the message's arrival [s]. */
  readonly lease?: number;
  /** Number of the receipt that answers the message; null: no answer. */
  readonly number?: number | null;
}

/** Stop driving. */
export interface Release {
  readonly op: "trundle/release";
  readonly topic: string;
}

/** Show this client's selection to the other users. */
export interface Presence {
  readonly op: "trundle/presence";
  readonly selection: SelectedModel | SelectedLink | SelectedJoint | SelectedLight | null;
}

/** Send input to a node's terminal, or change its size. */
export interface UseTerminal {
  readonly op: "trundle/terminal";
  readonly number: number;
  readonly text?: string;
  /** Columns and rows; null: unchanged. */
  readonly size?: readonly [number, number] | null;
}

/** Echo of a mark, after everything before it was handled. */
export interface Echo {
  readonly op: "trundle/echo";
  readonly mark: number;
}

/** Request to the page's owner; `trundle.page.requests.request` reads its fields. */
export interface PageRequest {
  readonly op: "trundle/request";
  readonly id: number | string;
  readonly request?: string;
}

export type ServerOperation =
  | ServerInfo
  | Status
  | RemoveStatus
  | AdvertiseChannels
  | UnadvertiseChannels
  | AdvertiseServices
  | UnadvertiseServices
  | ServiceCallFailure
  | ParameterValues
  | ConnectionGraphUpdate
  | Response
  | DriveReceipt;

export type ClientOperation =
  | Subscribe
  | Unsubscribe
  | Advertise
  | Unadvertise
  | GetParameters
  | SetParameters
  | SubscribeParameterUpdates
  | UnsubscribeParameterUpdates
  | SubscribeConnectionGraph
  | UnsubscribeConnectionGraph
  | FetchAsset
  | Drive
  | Release
  | Presence
  | UseTerminal
  | Echo
  | PageRequest;

export type SharedSelection = SelectedModel | SelectedLink | SelectedJoint | SelectedLight;

/** Requests, and their answers. */
export interface Requests {
  readonly play: { readonly fields: Play; readonly answer: Done };
  readonly pause: { readonly fields: Pause; readonly answer: Done };
  readonly step: { readonly fields: Step; readonly answer: Done };
  readonly run_to: { readonly fields: RunTo; readonly answer: Done };
  readonly reset: { readonly fields: Reset; readonly answer: Done };
  readonly reload: { readonly fields: Reload; readonly answer: Done };
  readonly speed: { readonly fields: SetSpeed; readonly answer: Done };
  readonly seek: { readonly fields: Seek; readonly answer: Done };
  readonly joint: { readonly fields: MoveJoint; readonly answer: Done };
  readonly place_joint: { readonly fields: PlaceJoint; readonly answer: Done };
  readonly pose: { readonly fields: SetPose; readonly answer: Done };
  readonly carry: { readonly fields: Carry; readonly answer: Done };
  readonly pull: { readonly fields: Pull; readonly answer: Done };
  readonly let_go: { readonly fields: LetGo; readonly answer: Done };
  readonly hold: { readonly fields: HoldModel; readonly answer: Done };
  readonly twist: { readonly fields: SetTwist; readonly answer: Done };
  readonly mass: { readonly fields: SetMass; readonly answer: Done };
  readonly friction: { readonly fields: SetFriction; readonly answer: Done };
  readonly light: { readonly fields: SetLight; readonly answer: Done };
  readonly place_light: { readonly fields: PlaceLight; readonly answer: Done };
  readonly physics: { readonly fields: SetPhysics; readonly answer: Done };
  readonly wrench: { readonly fields: ApplyWrench; readonly answer: Done };
  readonly save_world: { readonly fields: SaveWorld; readonly answer: SavedWorld | WorldText | FilesExist };
  readonly replay: { readonly fields: SaveReplay; readonly answer: ReplayPage | ReplayScene };
  readonly models: { readonly fields: ListModels; readonly answer: ModelList };
  readonly insert: { readonly fields: InsertModel; readonly answer: Inserted | CodeQuestion };
  readonly insert_light: { readonly fields: InsertLight; readonly answer: Inserted };
  readonly copy: { readonly fields: CopyModel; readonly answer: Done };
  readonly delete: { readonly fields: DeleteModel; readonly answer: Done };
  readonly restore: { readonly fields: RestoreModel; readonly answer: Done };
  readonly reset_model: { readonly fields: ResetModel; readonly answer: Done };
  readonly undo_reset: { readonly fields: UndoReset; readonly answer: Done };
  readonly delete_light: { readonly fields: DeleteLight; readonly answer: Done };
  readonly restore_light: { readonly fields: RestoreLight; readonly answer: Done };
  readonly begin_draft: { readonly fields: BeginDraft; readonly answer: Done };
  readonly draft_offers: { readonly fields: ListOffers; readonly answer: DraftOffers };
  readonly draft_set: { readonly fields: SetField; readonly answer: EditedPart };
  readonly draft_place: { readonly fields: PlaceLink; readonly answer: EditedPart };
  readonly draft_add: { readonly fields: AddPart; readonly answer: EditedPart };
  readonly draft_copy: { readonly fields: CopyPart; readonly answer: EditedPart };
  readonly draft_remove: { readonly fields: RemovePart; readonly answer: EditedPart };
  readonly draft_undo: { readonly fields: UndoDraft; readonly answer: EditedPart };
  readonly draft_redo: { readonly fields: RedoDraft; readonly answer: EditedPart };
  readonly draft_save: { readonly fields: SaveDraft; readonly answer: SavedFile | FilesExist };
  readonly draft_finish: { readonly fields: FinishDraft; readonly answer: Inserted | CodeQuestion };
  readonly draft_leave: { readonly fields: LeaveDraft; readonly answer: Done };
  readonly slider: { readonly fields: MoveSlider; readonly answer: Done };
  readonly joystick: { readonly fields: MoveJoystick; readonly answer: Done };
  readonly save_rviz: { readonly fields: SaveRviz; readonly answer: Done };
  readonly record: { readonly fields: Record; readonly answer: Done };
  readonly reference_offset: { readonly fields: SetReferenceOffset; readonly answer: Done };
  readonly stop_comparing: { readonly fields: StopComparing; readonly answer: Done };
  readonly definition: { readonly fields: Definition; readonly answer: DefinitionText };
  readonly plot: { readonly fields: PlotSeries; readonly answer: Done };
  readonly save_rviz_as: { readonly fields: SaveRvizAs; readonly answer: SavedFile | FilesExist };
  readonly lessons: { readonly fields: ListLessons; readonly answer: LessonList };
  readonly lesson: { readonly fields: OpenLesson; readonly answer: OpenedLesson };
  readonly lesson_file: { readonly fields: CheckLessonFile; readonly answer: FileState };
}

/** Content of channels whose encoding is JSON. */
export interface Channels {
  readonly "trundle/session": PageSession;
  readonly "trundle/world": Manifest;
  readonly "trundle/state": ClockState;
  readonly "trundle/performance": Profile;
  readonly "trundle/differences": Differences;
  readonly "trundle/reference": ReferenceInfo | null;
  readonly "trundle/drops": { readonly [name: string]: number };
  readonly "trundle/people": People;
  readonly "trundle/lanes": Lanes;
}
