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
    open_bag as open_bag,
    recover_messages as recover_messages,
    replaced_bag as replaced_bag,
)
from .play import Player as Player, PlayerOptions as PlayerOptions
from .record import Recorder as Recorder, RecorderOptions as RecorderOptions
from .step_recorder import StepRecorder as StepRecorder
from .summary import BagSummary as BagSummary, byte_text as byte_text, median_rates as median_rates
