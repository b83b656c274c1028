from .annotation import (
    Box2d as Box2d,
    Box3d as Box3d,
    CameraAnnotation as CameraAnnotation,
    KeyPointAnnotation as KeyPointAnnotation,
    Mask as Mask,
    ObjectAnnotation as ObjectAnnotation,
    PictureAnnotation as PictureAnnotation,
)
from .contact_sheet import shown_pictures as shown_pictures, write_contact_sheet as write_contact_sheet
from .dataset_folder import DatasetFolder as DatasetFolder
from .distractors import distractor_models as distractor_models
from .formats.catalog import format_of as format_of
from .instance import Instance as Instance
from .overlay import depth_image as depth_image, draw_overlay as draw_overlay, instance_image as instance_image
from .picture import AnnotatedPicture as AnnotatedPicture, PictureMaker as PictureMaker
from .plan import DatasetPlan as DatasetPlan, DistractorPlan as DistractorPlan, ObjectPlan as ObjectPlan
from .plan_reader import load_dataset_plan as load_dataset_plan, read_dataset_plan as read_dataset_plan
from .view import draw_view as draw_view
