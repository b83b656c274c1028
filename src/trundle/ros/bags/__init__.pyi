from .bag import (
    BagConnection as BagConnection,
    BagError as BagError,
    BagMessage as BagMessage,
    BagReader as BagReader,
    BagWriter as BagWriter,
    Chunk as Chunk,
    UnindexedBagError as UnindexedBagError,
)
from .files import (
    create_bag as create_bag,
    is_bag as is_bag,
    open_bag as open_bag,
    recover_messages as recover_messages,
    replaced_bag as replaced_bag,
)
from .play import Player as Player, PlayerOptions as PlayerOptions
from .record import Recorder as Recorder, RecorderOptions as RecorderOptions
from .recorded_numbers import (
    TF_TYPES as TF_TYPES,
    FramePoses as FramePoses,
    RecordedNumbers as RecordedNumbers,
    RecordedTopic as RecordedTopic,
    TopicNumbers as TopicNumbers,
    message_time as message_time,
    read_numbers as read_numbers,
    transform_poses as transform_poses,
)
from .step_recorder import StepRecorder as StepRecorder
from .summary import BagSummary as BagSummary, byte_text as byte_text, median_rates as median_rates
