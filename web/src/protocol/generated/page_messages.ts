/** Messages between the page's server and its client, made by web/schema. */

import type { Json } from "../json";

/** Greeting of a client. */
export interface ServerInfo {
  readonly op: "serverInfo";
  readonly name: string;
  /** Operations that the client may use, in the protocol's words. */
  readonly capabilities: readonly string[];
  readonly supportedEncodings: readonly string[];
  readonly metadata: { readonly [name: string]: string };
  /** Distinguishes this server from one before it at the same address. */
  readonly sessionId: string;
}

/** Sentence about the server; replaces the last one with its id. */
export interface Status {
  readonly op: "status";
  /** `INFO`, `WARNING` or `ERROR`. */
  readonly level: number;
  readonly message: string;
  readonly id?: string;
}

/** End of status messages, by id. */
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

/** End of channels and of their subscriptions. */
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

/** End of services. */
export interface UnadvertiseServices {
  readonly op: "unadvertiseServices";
  readonly serviceIds: readonly number[];
}

/** A call that has no response. */
export interface ServiceCallFailure {
  readonly op: "serviceCallFailure";
  readonly serviceId: number;
  readonly callId: number;
  readonly message: string;
}

/** Parameters that were asked for, or that have changed. */
export interface ParameterValues {
  readonly op: "parameterValues";
  readonly parameters: readonly Parameter[];
  /** Id of the request that it answers. */
  readonly id?: string;
}

/** Parameter and its value; unset: the parameter is deleted, or is not set. */
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

/** Nodes that publish a topic now. */
export interface PublishedTopic {
  readonly name: string;
  readonly publisherIds: readonly string[];
}

/** Nodes that subscribe to a topic now. */
export interface SubscribedTopic {
  readonly name: string;
  readonly subscriberIds: readonly string[];
  /** Datatype, `*` where it is not known; an addition to the protocol: without a publisher there is no channel. */
  readonly type: string;
}

/** Nodes that provide a service now. */
export interface ProvidedService {
  readonly name: string;
  readonly providerIds: readonly string[];
}

/** Answer to a request of `trundle.v1`; where it is `ok`, the fields of its `Answer` come along. */
export interface Response {
  readonly op: "trundle/response";
  readonly id: number | string;
  readonly ok: boolean;
  /** Sentence that says why it was not done. */
  readonly error?: string;
}

/** Session as a client gets it; another `kind` or `version` is another page, which loads again. */
export interface PageSession {
  readonly title: string;
  readonly kind: "bag" | "graph" | "log" | "simulation";
  /** Name of the robot that the page is about, for the tab's title. */
  readonly robot: string | null;
  readonly rviz: RvizFile | null;
  readonly fixed_frame: string | null;
  /** Namespace of the rviz node: of relative names in its file, of its tf and its parameters. */
  readonly namespace: string;
  /** Remappings of the rviz node: global name → global name. */
  readonly remappings: { readonly [name: string]: string };
  /** rqt's programs whose panels are open from the start: `rqt_graph`. */
  readonly panels: readonly string[];
  /** Curves of the plots panel: `/odom/pose/pose/position/x`. */
  readonly plots: readonly string[];
  /** Topics of pictures to show. */
  readonly images: readonly string[];
  /** Topic of velocity commands; null: driving is not offered. */
  readonly drive_topic: string | null;
  readonly sliders: readonly JointSlider[];
  /** true if a joystick is to be shown: the launch starts a joy node. */
  readonly joystick: boolean;
  readonly terminals: readonly NodeTerminal[];
  /** Version of the server. */
  readonly version: string;
  /** Address for Foxglove and Lichtblick. */
  readonly foxglove: string;
  /** Name of the page's node on the graph; null: there is no graph, or it is not joined yet. */
  readonly node: string | null;
  /** true if the server does nothing for this client that changes anything. */
  readonly view_only: boolean;
  /** Token of links that allow everything; null: this client only looks. */
  readonly token: string | null;
  /** Token of links that only allow looking. */
  readonly view_token: string;
}

/** The .rviz file that the page was started with, or that was saved there last. */
export interface RvizFile {
  readonly name: string;
  readonly text: string;
  /** true if it may be replaced. */
  readonly writable: boolean;
  /** true if it was saved at the page: `name` is its path from the working folder, and `SaveRvizAs` replaces it. */
  readonly saved: boolean;
}

/** A joint of joint_state_publisher_gui. */
export interface JointSlider {
  readonly name: string;
  /** [rad or m] */
  readonly lower: number;
  /** [rad or m] */
  readonly upper: number;
  /** [rad or m] */
  readonly position: number;
}

/** A node's terminal, whose channel is `trundle/terminal/N` with its place in the list. */
export interface NodeTerminal {
  /** Name of the node. */
  readonly name: string;
  /** Sentence on the end of the node; null: it runs. */
  readonly ended: string | null;
}

/** Simulated world; generation, file, files and draft are set as it is shown. */
export interface Manifest {
  /** Number that poses, joints and contacts of this world repeat. */
  readonly generation: number;
  readonly name: string;
  /** Path to save the world at; null: it cannot be written. */
  readonly file: string | null;
  /** In the order in which the models came. */
  readonly files: readonly FileUrl[];
  /** URL of a GLB. */
  readonly collisions: string | null;
  /** URLs of the meshes and images that these files name. */
  readonly resources: readonly string[];
  readonly scene: SceneSettings;
  readonly physics: PhysicsSettings;
  /** Body that is framed first. */
  readonly robot: number | null;
  readonly models: readonly ModelInfo[];
  /** Plugins of the world itself. */
  readonly plugins: readonly PluginInfo[];
  readonly lights: readonly LightInfo[];
  readonly cameras: readonly CameraInfo[];
  readonly frames: readonly FrameInfo[];
  /** Copy of a model that is edited, in whose place it is shown. */
  readonly draft: DraftInfo | null;
}

/** A GLB. */
export interface FileUrl {
  /** Name of a model, `draft`, or empty: lights of the world itself. */
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

/** Fog, with SDF's meaning. */
export interface Fog {
  readonly type: string;
  readonly color: readonly [number, number, number];
  /** [m] */
  readonly start: number;
  /** [m] */
  readonly end: number;
  readonly density: number;
}

/** Settings of the physics that can be edited. */
export interface PhysicsSettings {
  /** [m/s²] */
  readonly gravity: readonly [number, number, number];
  /** [m/s] */
  readonly wind: readonly [number, number, number];
  /** Time step [s]. */
  readonly step: number;
}

/** A model, with those nested in it. */
export interface ModelInfo {
  readonly name: string;
  readonly static: boolean;
  /** true if its base is fixed where it is, until it is freed. */
  readonly held: boolean;
  /** `file:line` */
  readonly source: string | null;
  readonly links: readonly LinkInfo[];
  readonly joints: readonly JointInfo[];
  readonly plugins: readonly PluginInfo[];
  readonly models: readonly ModelInfo[];
}

/** A link. */
export interface LinkInfo {
  readonly name: string;
  /** Number among the poses. */
  readonly body: number;
  /** [kg] */
  readonly mass: number;
  /** ixx iyy izz ixy ixz iyz [kg·m²]. */
  readonly inertia: readonly [number, number, number, number, number, number];
  readonly inertial_pose: readonly [number, number, number, number, number, number];
  /** mu and mu2; null: it has no collision. */
  readonly friction: readonly [number, number] | null;
  /** `file:line` */
  readonly source: string | null;
  readonly sensors: readonly SensorInfo[];
}

/** A sensor of a link, or of the joint above it. */
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

/** A plugin, as it was written. */
export interface PluginInfo {
  /** The second of one name has a number behind it. */
  readonly name: string;
  readonly filename: string;
  /** `file:line` */
  readonly source: string | null;
  /** Path below its element (`noise/stddev`) and text. */
  readonly parameters: readonly (readonly [string, string])[];
}

/** A joint. */
export interface JointInfo {
  readonly name: string;
  readonly type: string;
  readonly parent: string;
  readonly child: string;
  /** [rad or m]; null: no limit. */
  readonly lower: number | null;
  /** [rad or m]; null: no limit. */
  readonly upper: number | null;
  /** Frame of the joint in the child's. */
  readonly pose: readonly [number, number, number, number, number, number];
  /** Directions in the child's frame. */
  readonly axes: readonly (readonly [number, number, number])[];
  /** Row in `trundle/joints`; null: it has no single axis. */
  readonly index: number | null;
  /** `file:line` */
  readonly source: string | null;
}

/** A light of the world itself, or `model::link::name` of one on a link. */
export interface LightInfo {
  readonly name: string;
  readonly type: string;
  /** Body in whose frame its pose is; null: the world's. */
  readonly body: number | null;
  readonly pose: readonly [number, number, number, number, number, number];
  /** Direction of the light in its own frame. */
  readonly direction: readonly [number, number, number];
  /** Color, 0 to 1. */
  readonly diffuse: readonly [number, number, number];
  readonly intensity: number;
}

/** A camera. */
export interface CameraInfo {
  readonly name: string;
  readonly topic: string;
  /** Body in whose frame its pose is. */
  readonly body: number;
  readonly pose: readonly [number, number, number, number, number, number];
  /** [rad] */
  readonly horizontal_fov: number;
  /** [px] */
  readonly width: number;
  /** [px] */
  readonly height: number;
  /** Nearest that it draws [m]. */
  readonly near: number;
  /** Farthest that it draws [m]. */
  readonly far: number;
  /** [Hz] */
  readonly rate: number;
}

/** A frame of tf that moves with a body. */
export interface FrameInfo {
  readonly frame: string;
  readonly parent: string;
  readonly body: number;
}

/** A model that is edited. */
export interface DraftInfo {
  readonly name: string;
  /** Model of the world that it takes the place of; null: it is a new one. */
  readonly of: string | null;
  /** x y z [m], roll pitch yaw [rad] of the model in the world. */
  readonly pose: readonly [number, number, number, number, number, number];
  /** Edit that can be undone. */
  readonly undo: string | null;
  /** Edit that can be done again. */
  readonly redo: string | null;
  /** Folder to offer for saving; null: nothing can be written. */
  readonly folder: string | null;
  readonly files: readonly FileUrl[];
  /** The model itself, then what is in it, in the file's order. */
  readonly parts: readonly DraftPart[];
}

/** An element of the model. */
export interface DraftPart {
  /** Tags and names from the model down: ("link", "base", "sensor", "eye"); empty: the model itself. */
  readonly part: readonly string[];
  readonly tag: string;
  readonly name: string;
  /** Type, shape or file name. */
  readonly detail: string;
  /** [kg]; null: it is no link. */
  readonly mass: number | null;
  /** Number among the links; null: it is none. */
  readonly link: number | null;
  readonly line: number;
  readonly sections: readonly DraftSection[];
  readonly findings: readonly DraftFinding[];
}

/** Fields below one heading. */
export interface DraftSection {
  readonly title: string;
  readonly fields: readonly DraftField[];
}

/** One value of a part. */
export interface DraftField {
  /** Path of the element, `inertial/mass`; an attribute ends in `@name`. */
  readonly name: string;
  readonly label: string;
  readonly kind: "choice" | "colour" | "flag" | "number" | "pose" | "text" | "vector";
  readonly value: string | readonly number[] | boolean | null;
  readonly default: string | readonly number[] | boolean | null;
  readonly unit?: string;
  /** Names of a vector's numbers. */
  readonly labels?: readonly string[];
  readonly choices?: readonly string[];
  readonly least?: number;
  readonly most?: number;
}

/** Error or warning about a part. */
export interface DraftFinding {
  /** `error` or `warning`. */
  readonly severity: string;
  readonly text: string;
  /** Line of the draft's text. */
  readonly line: number | null;
}

/** The clock and its controls. */
export interface ClockState {
  readonly time_ns: number;
  readonly paused: boolean;
  /** Null: not known, or paused. */
  readonly real_time_factor: number | null;
  /** Wanted multiple of real time; null: as fast as possible. */
  readonly speed: number | null;
  /** Given for a recorded run. */
  readonly timeline?: TimelineSpan;
  /** Given where the run can be recorded; null: it is not. */
  readonly recording?: Recording | null;
}

/** Extent of a recorded run. */
export interface TimelineSpan {
  readonly start_ns: number;
  readonly end_ns: number;
}

/** A recording that runs. */
export interface Recording {
  readonly since_ns: number;
}

/** Wall times of an interval, with counts. */
export interface Profile {
  readonly wall_s: number;
  readonly simulated_s: number;
  readonly steps: number;
  /** Number of contacts of the last step. */
  readonly contacts: number;
  /** Number of links of all models. */
  readonly bodies: number;
  /** Number of resting trees of bodies, which the physics skips. */
  readonly asleep: number;
  /** Processor time of the graph's thread, which runs beside the simulation's; null: not known, or without ROS. */
  readonly graph_s: number | null;
  /** The most expensive first; their times add up to that of the interval. */
  readonly parts: readonly ProfilePart[];
}

/** One thing that takes wall time. */
export interface ProfilePart {
  readonly group: "cameras" | "other" | "page" | "physics" | "plugins" | "ros" | "sensors" | "waiting";
  readonly name: string;
  readonly wall_s: number;
}

/** People at the page. */
export interface People {
  /** Number of the person that this is sent to. */
  readonly you: number;
  readonly people: readonly Person[];
}

/** A client that subscribes to the channel. */
export interface Person {
  /** From 1; that of a person who has left is given again. */
  readonly number: number;
  readonly view_only: boolean;
  readonly selection: SelectedModel | SelectedLink | SelectedJoint | SelectedLight | null;
}

/** A model of the simulated world. */
export interface SelectedModel {
  readonly kind: "model";
  readonly model: string;
}

/** A link. */
export interface SelectedLink {
  readonly kind: "link";
  readonly model: string;
  readonly link: string;
}

/** A joint. */
export interface SelectedJoint {
  readonly kind: "joint";
  readonly model: string;
  readonly joint: string;
}

/** A light. */
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
  /** First and last bucket of each stretch without an empty bucket. */
  readonly bands: readonly (readonly [number, number])[];
}

/** Columns of plotted values behind their time. */
export interface SeriesHead {
  readonly names: readonly string[];
  readonly units: readonly string[];
  /** Name → sentence that says why it has no values. */
  readonly faults: { readonly [name: string]: string };
}

/** Answer to an upload. */
export interface UploadedModels {
  /** Names of what can be inserted now. */
  readonly models: readonly string[];
}

/** Metadata of the recording in a replay's file. */
export interface ReplayAbout {
  readonly title: string;
  /** Simulated time [s]. */
  readonly start: number;
  /** Simulated time [s]. */
  readonly end: number;
  readonly scene: SceneSettings;
  /** The view at first, as in an .rviz file; null: all that moves is framed. */
  readonly view: { readonly [name: string]: Json } | null;
}

/** The request was done. */
export type Done = { readonly [name: string]: never };

/** A world was written. */
export interface SavedWorld {
  /** Path as it was asked for. */
  readonly file: string;
  /** Parts of the world that the file does not hold. */
  readonly lost: readonly string[];
}

/** A world as SDF. */
export interface WorldText {
  readonly sdf: string;
  /** Parts of the world that the text does not hold. */
  readonly lost: readonly string[];
}

/** Nothing was written, as there are files that may not be replaced. */
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

/** A model that can be inserted. */
export interface ModelEntry {
  /** Folder's name. */
  readonly name: string;
  readonly title: string;
  readonly description: string;
  readonly uploaded: boolean;
}

/** A model or light was put into the world. */
export interface Inserted {
  /** Name in the world. */
  readonly name: string;
}

/** Nothing was inserted: a person has to agree that the model's code is run. */
export interface CodeQuestion {
  /** Files of code. */
  readonly code: readonly string[];
  /** Word that agrees to this code once. */
  readonly consent: string;
}

/** Parts that a draft can be given. */
export interface DraftOffers {
  readonly plugins: readonly PluginOffer[];
  /** Types. */
  readonly sensors: readonly string[];
  /** Types. */
  readonly joints: readonly string[];
  /** URIs. */
  readonly meshes: readonly string[];
}

/** A plugin that a draft can be given. */
export interface PluginOffer {
  readonly filename: string;
  /** Sentence on what it does. */
  readonly about: string;
}

/** The draft was edited. */
export interface EditedPart {
  /** Address of the part from now on; empty: the model itself. */
  readonly part: readonly string[];
}

/** A file, or a folder with files, was written. */
export interface SavedFile {
  /** Path as it was asked for. */
  readonly file: string;
}

/** Definition of a message type. */
export interface DefinitionText {
  /** With those of all types in it. */
  readonly definition: string;
}

/** Let time run. */
export type Play = { readonly [name: string]: never };

/** Stop time. */
export type Pause = { readonly [name: string]: never };

/** Pause, then take physics steps. */
export interface Step {
  readonly count?: number;
}

/** Pause, then take physics steps up to a time that is ahead. */
export interface RunTo {
  readonly time_ns: number;
}

/** Put time, poses or both back as loaded. */
export interface Reset {
  readonly what?: "all" | "poses" | "time";
}

/** Load the world again. */
export type Reload = { readonly [name: string]: never };

/** Pace time at a multiple of real time; null: as fast as possible. */
export interface SetSpeed {
  readonly factor: number | null;
}

/** Go to a time of a recorded run or bag. */
export interface Seek {
  readonly time_ns: number;
}

/** Drive a joint of a simulated model: one of position, velocity and effort is given. */
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

/** Set the position of a joint at once; its velocity stays, and no motor is switched. */
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
  /** Quaternion wxyz, of any length but zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Carry a model, at rest, so that one of its links has this pose; to be renewed within a second, until `let_go`. */
export interface Carry {
  readonly model: string;
  readonly link: string;
  /** In the world [m]. */
  readonly position: readonly [number, number, number];
  /** Quaternion wxyz, of any length but zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Pull a point of a link to a place by a spring; to be renewed within a second, until `let_go`. */
export interface Pull {
  readonly model: string;
  readonly link: string;
  /** In the link's frame [m]. */
  readonly point: readonly [number, number, number];
  /** In the world [m]. */
  readonly target: readonly [number, number, number];
}

/** Let a model go that is carried or pulled. */
export interface LetGo {
  readonly model: string;
}

/** Fix a model's base where it is, in the air too, or free it again. */
export interface HoldModel {
  readonly model: string;
  readonly on: boolean;
}

/** Set the velocity of a model once, world axes. */
export interface SetTwist {
  readonly model: string;
  /** [m/s] */
  readonly linear: readonly [number, number, number];
  /** [rad/s] */
  readonly angular: readonly [number, number, number];
}

/** Set the mass of a link; its moments of inertia change in proportion. */
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

/** Set the colour and intensity of a light. */
export interface SetLight {
  /** `name`, or `model::link::name` of one on a link. */
  readonly light: string;
  readonly diffuse: readonly [number, number, number];
  readonly intensity: number;
}

/** Move a light of the world itself. */
export interface PlaceLight {
  readonly light: string;
  /** In the world [m]. */
  readonly position: readonly [number, number, number];
  /** Quaternion wxyz, of any length but zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Set what is given of gravity, wind and time step. */
export interface SetPhysics {
  /** [m/s²] */
  readonly gravity?: readonly [number, number, number] | null;
  /** [m/s] */
  readonly wind?: readonly [number, number, number] | null;
  /** [s] */
  readonly step?: number | null;
}

/** Push a link at its centre of mass, world axes. */
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
  /** Path below the folder where the simulation was started; null: answer with the text, `sdf`. */
  readonly file: string | null;
  /** true if a person has agreed to replace the file. */
  readonly replace?: boolean;
}

/** Make a replay of the last minutes. */
export interface SaveReplay {
  /** JSON of the view from which a page is seen first, as an .rviz file has it. */
  readonly view?: string | null;
  readonly format?: "glb" | "html";
}

/** Ask for the models that can be inserted. */
export type ListModels = { readonly [name: string]: never };

/** Put a model of the model path, or a simple shape, into the world; a person is asked about a model with code. */
export interface InsertModel {
  /** Name of its folder, or `box`, `sphere`, `cylinder` where `is_shape`. */
  readonly model: string;
  /** Point on the floor [m]. */
  readonly position: readonly [number, number, number];
  readonly is_shape?: boolean;
  /** Word of the answer that showed the code, if a person has agreed. */
  readonly consent?: string | null;
}

/** Put a light above a point. */
export interface InsertLight {
  readonly type: "directional" | "point" | "spot";
  /** Point on the floor [m]. */
  readonly position: readonly [number, number, number];
}

/** Add a copy of a model in the state that it has, with its sensors and plugins. */
export interface CopyModel {
  readonly model: string;
  /** Name of the copy. */
  readonly name: string;
  /** From the model to its copy, in the world [m]. */
  readonly offset: readonly [number, number, number];
}

/** Remove a model from the world, with its sensors and plugins. */
export interface DeleteModel {
  readonly model: string;
}

/** Put back a model that the page deleted, in the state that it had, with its sensors and plugins. */
export interface RestoreModel {
  readonly model: string;
}

/** Put one model back as it came, with its joints, at rest and with its motors off; its plugins are reset. */
export interface ResetModel {
  readonly model: string;
}

/** Give a model the state before its newest reset, with motors, loads and what its plugins remember. */
export interface UndoReset {
  readonly model: string;
}

/** Remove a light of the world. */
export interface DeleteLight {
  readonly light: string;
}

/** Put back a light that the page deleted. */
export interface RestoreLight {
  readonly light: string;
}

/** Copy a model of the world, or begin one from nothing; time pauses until the draft is left. */
export interface BeginDraft {
  /** Null: a new one. */
  readonly model: string | null;
  /** Place of a new one [m]. */
  readonly position?: readonly [number, number, number];
}

/** Ask for the plugins, sensors and meshes that a draft can be given. */
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
  /** Quaternion wxyz, of any length but zero. */
  readonly orientation: readonly [number, number, number, number];
}

/** Add a part. */
export interface AddPart {
  /** Part that gets it; of a joint, its child. */
  readonly into: readonly string[];
  readonly kind: "collision" | "joint" | "link" | "plugin" | "sensor" | "visual";
  /** Shape or URI of a mesh, type of the joint or sensor, file name of the plugin. */
  readonly type: string;
}

/** Add a copy of a part. */
export interface CopyPart {
  readonly part: readonly string[];
}

/** Remove a part; a link goes with its joints. */
export interface RemovePart {
  readonly part: readonly string[];
}

/** Take the last edit of the draft back. */
export type UndoDraft = { readonly [name: string]: never };

/** Do the edit again that was taken back last. */
export type RedoDraft = { readonly [name: string]: never };

/** Write model.sdf and model.config. */
export interface SaveDraft {
  /** Path below the folder where the simulation was started. */
  readonly folder: string;
  /** true if a person has agreed to replace the files. */
  readonly replace?: boolean;
}

/**
 * Put the draft into the world, in place of the model that it is a copy of.
 *
 * A person is asked about a model with code.
 */
export interface FinishDraft {
  /** Word of the answer that showed the code, if a person has agreed. */
  readonly consent?: string | null;
}

/** Throw the draft away. */
export type LeaveDraft = { readonly [name: string]: never };

/** Move a joint of joint_state_publisher_gui. */
export interface MoveSlider {
  readonly joint: string;
  /** [rad or m] */
  readonly position: number;
}

/** Positions of a joystick's axes, −1 to 1, and buttons, 0 or 1, in joy's order. */
export interface MoveJoystick {
  readonly axes: readonly number[];
  readonly buttons: readonly (0 | 1)[];
}

/** Replace the .rviz file that the page was started with. */
export interface SaveRviz {
  readonly text: string;
}

/** Begin or end recording. */
export interface Record {
  readonly on: boolean;
}

/** Text of a message type; the server itself answers. */
export interface Definition {
  readonly type: string;
}

/** Sample these values of the simulation for `trundle/series`, and no others; the server itself answers. */
export interface PlotSeries {
  /** Names such as `rp2w::chassis.pose.x`. */
  readonly series: readonly string[];
}

/** Save an .rviz file below the folder where Trundle was started, as `SaveWorld` does; the server itself does it. */
export interface SaveRvizAs {
  readonly file: string;
  readonly text: string;
  /** true: a file of that name is replaced. */
  readonly replace?: boolean;
}

/**
 * Draw the scene by Trundle's own renderer, for browsers without WebGL; answered by `PageServer.respond_picture`.
 *
 * The camera looks at what the page frames first, from a distance, turned about z and raised.
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
  /** A PNG, or the GLB of what follows the pointer until it is placed. */
  readonly kind?: "picture" | "shape";
}

/** Begin to receive channels. */
export interface Subscribe {
  readonly op: "subscribe";
  readonly subscriptions: readonly Subscription[];
}

/** Channel that a client subscribes to, under a number of its own. */
export interface Subscription {
  readonly id: number;
  readonly channelId: number;
}

/** Stop receiving. */
export interface Unsubscribe {
  readonly op: "unsubscribe";
  readonly subscriptionIds: readonly number[];
}

/** Announce topics of the client. */
export interface Advertise {
  readonly op: "advertise";
  readonly channels: readonly ClientChannel[];
}

/** Topic that a client publishes. */
export interface ClientChannel {
  readonly id: number;
  readonly topic: string;
  readonly encoding: string;
  readonly schemaName: string;
  readonly schema?: string | null;
}

/** End topics of the client. */
export interface Unadvertise {
  readonly op: "unadvertise";
  readonly channelIds: readonly number[];
}

/** Ask for parameters; no names: all of them. */
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

/** Ask for changes of parameters; no names: of all. */
export interface SubscribeParameterUpdates {
  readonly op: "subscribeParameterUpdates";
  readonly parameterNames: readonly string[];
}

/** Ask for changes no more; no names: of none. */
export interface UnsubscribeParameterUpdates {
  readonly op: "unsubscribeParameterUpdates";
  readonly parameterNames: readonly string[];
}

/** Ask for nodes of topics and services. */
export interface SubscribeConnectionGraph {
  readonly op: "subscribeConnectionGraph";
}

/** Ask for nodes of topics and services no more. */
export interface UnsubscribeConnectionGraph {
  readonly op: "unsubscribeConnectionGraph";
}

/** Ask for a file. */
export interface FetchAsset {
  readonly op: "fetchAsset";
  readonly uri: string;
  readonly requestId: number;
}

/** Drive at a velocity, until 0.3 s pass without the next such message. */
export interface Drive {
  readonly op: "trundle/drive";
  readonly topic: string;
  /** Forward [m/s]. */
  readonly linear: number;
  /** To the left [rad/s]. */
  readonly angular: number;
}

/** Stop driving. */
export interface Release {
  readonly op: "trundle/release";
  readonly topic: string;
}

/** Show the others what this client has selected. */
export interface Presence {
  readonly op: "trundle/presence";
  readonly selection: SelectedModel | SelectedLink | SelectedJoint | SelectedLight | null;
}

/** Type into a node's terminal, or change its size. */
export interface UseTerminal {
  readonly op: "trundle/terminal";
  readonly number: number;
  readonly text?: string;
  /** Columns and rows; null: as it is. */
  readonly size?: readonly [number, number] | null;
}

/** Request to the page's owner; its fields are read by `trundle.page.requests.request`. */
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
  | Response;

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
  readonly definition: { readonly fields: Definition; readonly answer: DefinitionText };
  readonly plot: { readonly fields: PlotSeries; readonly answer: Done };
  readonly save_rviz_as: { readonly fields: SaveRvizAs; readonly answer: SavedFile | FilesExist };
}

/** Content of channels whose encoding is JSON. */
export interface Channels {
  readonly "trundle/session": PageSession;
  readonly "trundle/world": Manifest;
  readonly "trundle/state": ClockState;
  readonly "trundle/performance": Profile;
  readonly "trundle/drops": { readonly [name: string]: number };
  readonly "trundle/people": People;
  readonly "trundle/lanes": Lanes;
}
