/** Checks of the messages that the page receives, made by web/schema. */

import * as is from "../check";
import type * as page from "./page_messages";

export const serverInfo: is.Check<page.ServerInfo> = is.struct(() => ({
  op: is.literal("serverInfo"),
  name: is.text,
  capabilities: is.list(is.text),
  supportedEncodings: is.list(is.text),
  metadata: is.record(is.text),
  sessionId: is.text,
}));

export const status: is.Check<page.Status> = is.struct(() => ({
  op: is.literal("status"),
  level: is.number,
  message: is.text,
  id: is.optional(is.text),
}));

export const removeStatus: is.Check<page.RemoveStatus> = is.struct(() => ({
  op: is.literal("removeStatus"),
  statusIds: is.list(is.text),
}));

export const advertiseChannels: is.Check<page.AdvertiseChannels> = is.struct(() => ({
  op: is.literal("advertise"),
  channels: is.list(channelOffer),
}));

export const channelOffer: is.Check<page.ChannelOffer> = is.struct(() => ({
  id: is.number,
  topic: is.text,
  encoding: is.text,
  schemaName: is.text,
  schema: is.text,
  schemaEncoding: is.optional(is.text),
}));

export const unadvertiseChannels: is.Check<page.UnadvertiseChannels> = is.struct(() => ({
  op: is.literal("unadvertise"),
  channelIds: is.list(is.number),
}));

export const advertiseServices: is.Check<page.AdvertiseServices> = is.struct(() => ({
  op: is.literal("advertiseServices"),
  services: is.list(serviceOffer),
}));

export const serviceOffer: is.Check<page.ServiceOffer> = is.struct(() => ({
  id: is.number,
  name: is.text,
  type: is.text,
  request: serviceSchema,
  response: serviceSchema,
  requestSchema: is.text,
  responseSchema: is.text,
}));

export const serviceSchema: is.Check<page.ServiceSchema> = is.struct(() => ({
  encoding: is.text,
  schemaEncoding: is.text,
  schemaName: is.text,
  schema: is.text,
}));

export const unadvertiseServices: is.Check<page.UnadvertiseServices> = is.struct(() => ({
  op: is.literal("unadvertiseServices"),
  serviceIds: is.list(is.number),
}));

export const serviceCallFailure: is.Check<page.ServiceCallFailure> = is.struct(() => ({
  op: is.literal("serviceCallFailure"),
  serviceId: is.number,
  callId: is.number,
  message: is.text,
}));

export const parameterValues: is.Check<page.ParameterValues> = is.struct(() => ({
  op: is.literal("parameterValues"),
  parameters: is.list(parameter),
  id: is.optional(is.text),
}));

export const parameter: is.Check<page.Parameter> = is.struct(() => ({
  name: is.text,
  value: is.optional(is.json),
  type: is.optional(is.nullable(is.literal("byte_array", "float64", "float64_array"))),
}));

export const connectionGraphUpdate: is.Check<page.ConnectionGraphUpdate> = is.struct(() => ({
  op: is.literal("connectionGraphUpdate"),
  publishedTopics: is.list(publishedTopic),
  subscribedTopics: is.list(subscribedTopic),
  advertisedServices: is.list(providedService),
  removedTopics: is.list(is.text),
  removedServices: is.list(is.text),
}));

export const publishedTopic: is.Check<page.PublishedTopic> = is.struct(() => ({
  name: is.text,
  publisherIds: is.list(is.text),
}));

export const subscribedTopic: is.Check<page.SubscribedTopic> = is.struct(() => ({
  name: is.text,
  subscriberIds: is.list(is.text),
  type: is.text,
}));

export const providedService: is.Check<page.ProvidedService> = is.struct(() => ({
  name: is.text,
  providerIds: is.list(is.text),
}));

export const response: is.Check<page.Response> = is.struct(() => ({
  op: is.literal("trundle/response"),
  id: is.oneOf(is.number, is.text),
  ok: is.flag,
  error: is.optional(is.text),
}));

export const driveReceipt: is.Check<page.DriveReceipt> = is.struct(() => ({
  op: is.literal("trundle/driven"),
  number: is.number,
}));

export const pageSession: is.Check<page.PageSession> = is.struct(() => ({
  title: is.text,
  kind: is.literal("bag", "graph", "log", "simulation"),
  robot: is.nullable(is.text),
  rviz: is.nullable(rvizFile),
  fixed_frame: is.nullable(is.text),
  namespace: is.text,
  remappings: is.record(is.text),
  panels: is.list(is.text),
  plots: is.list(is.text),
  images: is.list(is.text),
  drive_topic: is.nullable(is.text),
  sliders: is.list(jointSlider),
  joystick: is.flag,
  terminals: is.list(nodeTerminal),
  lesson: is.nullable(is.text),
  version: is.text,
  foxglove: is.text,
  node: is.nullable(is.text),
  view_only: is.flag,
  token: is.nullable(is.text),
  view_token: is.text,
  network_urls: is.list(is.text),
}));

export const rvizFile: is.Check<page.RvizFile> = is.struct(() => ({
  name: is.text,
  text: is.text,
  writable: is.flag,
  saved: is.flag,
}));

export const jointSlider: is.Check<page.JointSlider> = is.struct(() => ({
  name: is.text,
  lower: is.float,
  upper: is.float,
  position: is.float,
}));

export const nodeTerminal: is.Check<page.NodeTerminal> = is.struct(() => ({
  name: is.text,
  ended: is.nullable(is.text),
}));

export const manifest: is.Check<page.Manifest> = is.struct(() => ({
  generation: is.number,
  name: is.text,
  file: is.nullable(is.text),
  files: is.list(fileUrl),
  collisions: is.nullable(is.text),
  resources: is.list(is.text),
  scene: sceneSettings,
  physics: physicsSettings,
  robot: is.nullable(is.number),
  models: is.list(modelInfo),
  plugins: is.list(pluginInfo),
  lights: is.list(lightInfo),
  cameras: is.list(cameraInfo),
  frames: is.list(frameInfo),
  draft: is.nullable(draftInfo),
  reference: is.nullable(referenceInfo),
}));

export const fileUrl: is.Check<page.FileUrl> = is.struct(() => ({ id: is.text, url: is.text }));

export const sceneSettings: is.Check<page.SceneSettings> = is.struct(() => ({
  ambient: is.tuple(is.float, is.float, is.float),
  background: is.tuple(is.float, is.float, is.float),
  sky: is.flag,
  shadows: is.flag,
  grid: is.flag,
  fog: is.nullable(fog),
}));

export const fog: is.Check<page.Fog> = is.struct(() => ({
  type: is.text,
  color: is.tuple(is.float, is.float, is.float),
  start: is.float,
  end: is.float,
  density: is.float,
}));

export const physicsSettings: is.Check<page.PhysicsSettings> = is.struct(() => ({
  gravity: is.tuple(is.float, is.float, is.float),
  wind: is.tuple(is.float, is.float, is.float),
  step: is.float,
}));

export const modelInfo: is.Check<page.ModelInfo> = is.struct(() => ({
  name: is.text,
  static: is.flag,
  held: is.flag,
  source: is.nullable(is.text),
  links: is.list(linkInfo),
  joints: is.list(jointInfo),
  plugins: is.list(pluginInfo),
  models: is.list(modelInfo),
}));

export const linkInfo: is.Check<page.LinkInfo> = is.struct(() => ({
  name: is.text,
  body: is.number,
  mass: is.float,
  inertia: is.tuple(is.float, is.float, is.float, is.float, is.float, is.float),
  inertial_pose: is.tuple(is.float, is.float, is.float, is.float, is.float, is.float),
  friction: is.nullable(is.tuple(is.float, is.float)),
  source: is.nullable(is.text),
  sensors: is.list(sensorInfo),
}));

export const sensorInfo: is.Check<page.SensorInfo> = is.struct(() => ({
  name: is.text,
  type: is.text,
  rate: is.float,
  topic: is.nullable(is.text),
  series: is.list(is.text),
  source: is.nullable(is.text),
  plugins: is.list(pluginInfo),
}));

export const pluginInfo: is.Check<page.PluginInfo> = is.struct(() => ({
  name: is.text,
  filename: is.text,
  source: is.nullable(is.text),
  parameters: is.list(is.tuple(is.text, is.text)),
}));

export const jointInfo: is.Check<page.JointInfo> = is.struct(() => ({
  name: is.text,
  type: is.text,
  parent: is.text,
  child: is.text,
  lower: is.nullable(is.float),
  upper: is.nullable(is.float),
  pose: is.tuple(is.float, is.float, is.float, is.float, is.float, is.float),
  axes: is.list(is.tuple(is.float, is.float, is.float)),
  index: is.nullable(is.number),
  source: is.nullable(is.text),
}));

export const lightInfo: is.Check<page.LightInfo> = is.struct(() => ({
  name: is.text,
  type: is.text,
  body: is.nullable(is.number),
  pose: is.tuple(is.float, is.float, is.float, is.float, is.float, is.float),
  direction: is.tuple(is.float, is.float, is.float),
  diffuse: is.tuple(is.float, is.float, is.float),
  intensity: is.float,
}));

export const cameraInfo: is.Check<page.CameraInfo> = is.struct(() => ({
  name: is.text,
  topic: is.text,
  body: is.number,
  pose: is.tuple(is.float, is.float, is.float, is.float, is.float, is.float),
  horizontal_fov: is.float,
  width: is.number,
  height: is.number,
  near: is.float,
  far: is.float,
  rate: is.float,
}));

export const frameInfo: is.Check<page.FrameInfo> = is.struct(() => ({
  frame: is.text,
  parent: is.text,
  body: is.number,
}));

export const draftInfo: is.Check<page.DraftInfo> = is.struct(() => ({
  name: is.text,
  original: is.nullable(is.text),
  pose: is.tuple(is.float, is.float, is.float, is.float, is.float, is.float),
  undo: is.nullable(is.text),
  redo: is.nullable(is.text),
  folder: is.nullable(is.text),
  files: is.list(fileUrl),
  parts: is.list(draftPart),
}));

export const draftPart: is.Check<page.DraftPart> = is.struct(() => ({
  part: is.list(is.text),
  tag: is.text,
  name: is.text,
  detail: is.text,
  mass: is.nullable(is.float),
  link: is.nullable(is.number),
  line: is.number,
  sections: is.list(draftSection),
  findings: is.list(draftFinding),
}));

export const draftSection: is.Check<page.DraftSection> = is.struct(() => ({
  title: is.text,
  fields: is.list(draftField),
}));

export const draftField: is.Check<page.DraftField> = is.struct(() => ({
  name: is.text,
  label: is.text,
  kind: is.literal("choice", "color", "flag", "number", "pose", "text", "vector"),
  value: is.nullable(is.oneOf(is.text, is.list(is.float), is.flag)),
  default: is.nullable(is.oneOf(is.text, is.list(is.float), is.flag)),
  unit: is.optional(is.text),
  labels: is.optional(is.list(is.text)),
  choices: is.optional(is.list(is.text)),
  minimum: is.optional(is.float),
  maximum: is.optional(is.float),
}));

export const draftFinding: is.Check<page.DraftFinding> = is.struct(() => ({
  severity: is.text,
  text: is.text,
  line: is.nullable(is.number),
}));

export const referenceInfo: is.Check<page.ReferenceInfo> = is.struct(() => ({
  title: is.text,
  url: is.text,
  start: is.float,
  offset: is.float,
  duration: is.float,
  samples: is.number,
  links: is.list(is.text),
  joints: is.list(is.text),
  topics: is.list(referenceTopic),
  root: is.text,
}));

export const referenceTopic: is.Check<page.ReferenceTopic> = is.struct(() => ({
  topic: is.text,
  samples: is.number,
  paths: is.list(is.text),
}));

export const clockState: is.Check<page.ClockState> = is.struct(() => ({
  time_ns: is.number,
  paused: is.flag,
  real_time_factor: is.nullable(is.float),
  speed: is.nullable(is.float),
  timeline: is.optional(timelineSpan),
  recording: is.optional(is.nullable(recording)),
}));

export const timelineSpan: is.Check<page.TimelineSpan> = is.struct(() => ({ start_ns: is.number, end_ns: is.number }));

export const recording: is.Check<page.Recording> = is.struct(() => ({ since_ns: is.number }));

export const profile: is.Check<page.Profile> = is.struct(() => ({
  wall_s: is.float,
  simulated_s: is.float,
  steps: is.number,
  contacts: is.number,
  bodies: is.number,
  asleep: is.number,
  graph_s: is.nullable(is.float),
  parts: is.list(profilePart),
}));

export const profilePart: is.Check<page.ProfilePart> = is.struct(() => ({
  group: is.literal("cameras", "other", "page", "physics", "plugins", "ros", "sensors", "waiting"),
  name: is.text,
  wall_s: is.float,
}));

export const differences: is.Check<page.Differences> = is.struct(() => ({ time: is.float, rows: is.list(difference) }));

export const difference: is.Check<page.Difference> = is.struct(() => ({
  name: is.text,
  quantity: is.literal("angle", "angular velocity", "distance", "position", "value", "velocity"),
  now: is.nullable(is.float),
  maximum: is.nullable(is.float),
  maximum_time: is.nullable(is.float),
  rms: is.nullable(is.float),
}));

export const people: is.Check<page.People> = is.struct(() => ({ you: is.number, people: is.list(person) }));

export const person: is.Check<page.Person> = is.struct(() => ({
  number: is.number,
  view_only: is.flag,
  selection: is.nullable(
    is.tagged("kind", () => ({ model: selectedModel, link: selectedLink, joint: selectedJoint, light: selectedLight })),
  ),
}));

export const selectedModel: is.Check<page.SelectedModel> = is.struct(() => ({
  kind: is.literal("model"),
  model: is.text,
}));

export const selectedLink: is.Check<page.SelectedLink> = is.struct(() => ({
  kind: is.literal("link"),
  model: is.text,
  link: is.text,
}));

export const selectedJoint: is.Check<page.SelectedJoint> = is.struct(() => ({
  kind: is.literal("joint"),
  model: is.text,
  joint: is.text,
}));

export const selectedLight: is.Check<page.SelectedLight> = is.struct(() => ({
  kind: is.literal("light"),
  light: is.text,
}));

export const lanes: is.Check<page.Lanes> = is.struct(() => ({
  start_ns: is.number,
  bucket_ns: is.number,
  topics: is.record(lane),
}));

export const lane: is.Check<page.Lane> = is.struct(() => ({
  count: is.number,
  bands: is.list(is.tuple(is.number, is.number)),
}));

export const seriesHead: is.Check<page.SeriesHead> = is.struct(() => ({
  names: is.list(is.text),
  units: is.list(is.text),
  faults: is.record(is.text),
}));

export const uploadedModels: is.Check<page.UploadedModels> = is.struct(() => ({ models: is.list(is.text) }));

export const uploadedRecording: is.Check<page.UploadedRecording> = is.struct(() => ({ title: is.text }));

export const replayAbout: is.Check<page.ReplayAbout> = is.struct(() => ({
  title: is.text,
  start: is.float,
  end: is.float,
  scene: sceneSettings,
  view: is.nullable(is.record(is.json)),
}));

export const done: is.Check<page.Done> = is.struct(() => ({}));

export const savedWorld: is.Check<page.SavedWorld> = is.struct(() => ({ file: is.text, lost: is.list(is.text) }));

export const worldText: is.Check<page.WorldText> = is.struct(() => ({ sdf: is.text, lost: is.list(is.text) }));

export const filesExist: is.Check<page.FilesExist> = is.struct(() => ({ exists: is.text }));

export const replayPage: is.Check<page.ReplayPage> = is.struct(() => ({ html: is.text }));

export const replayScene: is.Check<page.ReplayScene> = is.struct(() => ({ glb: is.text }));

export const modelList: is.Check<page.ModelList> = is.struct(() => ({ models: is.list(modelEntry) }));

export const modelEntry: is.Check<page.ModelEntry> = is.struct(() => ({
  name: is.text,
  title: is.text,
  description: is.text,
  uploaded: is.flag,
}));

export const inserted: is.Check<page.Inserted> = is.struct(() => ({ name: is.text }));

export const codeQuestion: is.Check<page.CodeQuestion> = is.struct(() => ({
  code: is.list(is.text),
  consent: is.text,
}));

export const draftOffers: is.Check<page.DraftOffers> = is.struct(() => ({
  plugins: is.list(pluginOffer),
  sensors: is.list(is.text),
  joints: is.list(is.text),
  meshes: is.list(is.text),
}));

export const pluginOffer: is.Check<page.PluginOffer> = is.struct(() => ({ filename: is.text, about: is.text }));

export const editedPart: is.Check<page.EditedPart> = is.struct(() => ({ part: is.list(is.text) }));

export const savedFile: is.Check<page.SavedFile> = is.struct(() => ({ file: is.text }));

export const definitionText: is.Check<page.DefinitionText> = is.struct(() => ({ definition: is.text }));

export const lessonList: is.Check<page.LessonList> = is.struct(() => ({ lessons: is.list(lessonEntry) }));

export const lessonEntry: is.Check<page.LessonEntry> = is.struct(() => ({ name: is.text, title: is.text }));

export const openedLesson: is.Check<page.OpenedLesson> = is.struct(() => ({ lesson: lesson }));

export const lesson: is.Check<page.Lesson> = is.struct(() => ({
  title: is.text,
  start: is.text,
  needs: is.list(statedCheck),
  steps: is.list(lessonStep),
}));

export const statedCheck: is.Check<page.StatedCheck> = is.struct(() => ({
  sentence: is.text,
  check: is.tagged("check", () => ({
    file: fileCheck,
    model: modelCheck,
    robot: robotCheck,
    selected: selectedCheck,
    moved: movedCheck,
    frame_moved: frameMovedCheck,
    joint_moved: jointMovedCheck,
    node: nodeCheck,
    publishes: publishesCheck,
    subscribes: subscribesCheck,
    rate: rateCheck,
    fixed_frame: fixedFrameCheck,
  })),
}));

export const fileCheck: is.Check<page.FileCheck> = is.struct(() => ({ check: is.literal("file"), path: is.text }));

export const modelCheck: is.Check<page.ModelCheck> = is.struct(() => ({ check: is.literal("model"), model: is.text }));

export const robotCheck: is.Check<page.RobotCheck> = is.struct(() => ({ check: is.literal("robot"), name: is.text }));

export const selectedCheck: is.Check<page.SelectedCheck> = is.struct(() => ({
  check: is.literal("selected"),
  model: is.text,
}));

export const movedCheck: is.Check<page.MovedCheck> = is.struct(() => ({
  check: is.literal("moved"),
  model: is.text,
  distance: is.float,
}));

export const frameMovedCheck: is.Check<page.FrameMovedCheck> = is.struct(() => ({
  check: is.literal("frame_moved"),
  frame: is.text,
  reference: is.text,
  distance: is.float,
}));

export const jointMovedCheck: is.Check<page.JointMovedCheck> = is.struct(() => ({
  check: is.literal("joint_moved"),
  model: is.text,
  joint: is.text,
  by: is.float,
}));

export const nodeCheck: is.Check<page.NodeCheck> = is.struct(() => ({ check: is.literal("node"), node: is.text }));

export const publishesCheck: is.Check<page.PublishesCheck> = is.struct(() => ({
  check: is.literal("publishes"),
  topic: is.text,
}));

export const subscribesCheck: is.Check<page.SubscribesCheck> = is.struct(() => ({
  check: is.literal("subscribes"),
  topic: is.text,
}));

export const rateCheck: is.Check<page.RateCheck> = is.struct(() => ({
  check: is.literal("rate"),
  topic: is.text,
  hz: is.float,
}));

export const fixedFrameCheck: is.Check<page.FixedFrameCheck> = is.struct(() => ({
  check: is.literal("fixed_frame"),
  frame: is.text,
}));

export const lessonStep: is.Check<page.LessonStep> = is.struct(() => ({
  title: is.text,
  blocks: is.list(
    is.tagged("kind", () => ({
      paragraph: paragraph,
      heading: heading,
      list: itemList,
      quotation: quotation,
      code_block: codeBlock,
    })),
  ),
  checks: is.list(statedCheck),
  parts: is.list(
    is.literal(
      "cameras",
      "clock",
      "compare",
      "displays",
      "drive",
      "graph",
      "images",
      "insert",
      "inspector",
      "joints",
      "joystick",
      "log",
      "motion_planning",
      "navigation",
      "nodes",
      "parameters",
      "performance",
      "play",
      "plots",
      "reconfigure",
      "reset",
      "services",
      "steering",
      "terminal",
      "tf_tree",
      "timeline",
      "tools",
      "topics",
      "views",
      "world",
    ),
  ),
  models: is.list(is.text),
}));

export const paragraph: is.Check<page.Paragraph> = is.struct(() => ({
  kind: is.literal("paragraph"),
  content: is.list(
    is.tagged("kind", () => ({ text: plainText, code: codeSpan, break: lineBreak, emphasis: emphasis, link: webLink })),
  ),
}));

export const plainText: is.Check<page.PlainText> = is.struct(() => ({ kind: is.literal("text"), text: is.text }));

export const codeSpan: is.Check<page.CodeSpan> = is.struct(() => ({ kind: is.literal("code"), text: is.text }));

export const lineBreak: is.Check<page.LineBreak> = is.struct(() => ({ kind: is.literal("break") }));

export const emphasis: is.Check<page.Emphasis> = is.struct(() => ({
  kind: is.literal("emphasis"),
  strong: is.flag,
  content: is.list(
    is.tagged("kind", () => ({ text: plainText, code: codeSpan, break: lineBreak, emphasis: emphasis, link: webLink })),
  ),
}));

export const webLink: is.Check<page.WebLink> = is.struct(() => ({
  kind: is.literal("link"),
  url: is.text,
  content: is.list(
    is.tagged("kind", () => ({ text: plainText, code: codeSpan, break: lineBreak, emphasis: emphasis, link: webLink })),
  ),
}));

export const heading: is.Check<page.Heading> = is.struct(() => ({
  kind: is.literal("heading"),
  content: is.list(
    is.tagged("kind", () => ({ text: plainText, code: codeSpan, break: lineBreak, emphasis: emphasis, link: webLink })),
  ),
}));

export const itemList: is.Check<page.ItemList> = is.struct(() => ({
  kind: is.literal("list"),
  ordered: is.flag,
  first: is.number,
  items: is.list(
    is.list(
      is.tagged("kind", () => ({
        paragraph: paragraph,
        heading: heading,
        list: itemList,
        quotation: quotation,
        code_block: codeBlock,
      })),
    ),
  ),
}));

export const quotation: is.Check<page.Quotation> = is.struct(() => ({
  kind: is.literal("quotation"),
  blocks: is.list(
    is.tagged("kind", () => ({
      paragraph: paragraph,
      heading: heading,
      list: itemList,
      quotation: quotation,
      code_block: codeBlock,
    })),
  ),
}));

export const codeBlock: is.Check<page.CodeBlock> = is.struct(() => ({
  kind: is.literal("code_block"),
  language: is.text,
  title: is.text,
  text: is.text,
}));

export const fileState: is.Check<page.FileState> = is.struct(() => ({ fault: is.nullable(is.text) }));

export const serverOperation: is.Check<page.ServerOperation> = is.tagged("op", () => ({
  serverInfo: serverInfo,
  status: status,
  removeStatus: removeStatus,
  advertise: advertiseChannels,
  unadvertise: unadvertiseChannels,
  advertiseServices: advertiseServices,
  unadvertiseServices: unadvertiseServices,
  serviceCallFailure: serviceCallFailure,
  parameterValues: parameterValues,
  connectionGraphUpdate: connectionGraphUpdate,
  "trundle/response": response,
  "trundle/driven": driveReceipt,
}));

export const answers: { readonly [N in keyof page.Requests]: is.Check<page.Requests[N]["answer"]> } = {
  play: done,
  pause: done,
  step: done,
  run_to: done,
  reset: done,
  reload: done,
  speed: done,
  seek: done,
  joint: done,
  place_joint: done,
  pose: done,
  carry: done,
  pull: done,
  let_go: done,
  hold: done,
  twist: done,
  mass: done,
  friction: done,
  light: done,
  place_light: done,
  physics: done,
  wrench: done,
  save_world: is.oneOf(savedWorld, worldText, filesExist),
  replay: is.oneOf(replayPage, replayScene),
  models: modelList,
  insert: is.oneOf(inserted, codeQuestion),
  insert_light: inserted,
  copy: done,
  delete: done,
  restore: done,
  reset_model: done,
  undo_reset: done,
  delete_light: done,
  restore_light: done,
  begin_draft: done,
  draft_offers: draftOffers,
  draft_set: editedPart,
  draft_place: editedPart,
  draft_add: editedPart,
  draft_copy: editedPart,
  draft_remove: editedPart,
  draft_undo: editedPart,
  draft_redo: editedPart,
  draft_save: is.oneOf(savedFile, filesExist),
  draft_finish: is.oneOf(inserted, codeQuestion),
  draft_leave: done,
  slider: done,
  joystick: done,
  save_rviz: done,
  record: done,
  reference_offset: done,
  stop_comparing: done,
  definition: definitionText,
  plot: done,
  save_rviz_as: is.oneOf(savedFile, filesExist),
  lessons: lessonList,
  lesson: openedLesson,
  lesson_file: fileState,
};

export const channels: { readonly [T in keyof page.Channels]: is.Check<page.Channels[T]> } = {
  "trundle/session": pageSession,
  "trundle/world": manifest,
  "trundle/state": clockState,
  "trundle/performance": profile,
  "trundle/differences": differences,
  "trundle/reference": is.nullable(referenceInfo),
  "trundle/drops": is.record(is.number),
  "trundle/people": people,
  "trundle/lanes": lanes,
};
