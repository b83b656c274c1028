"""Writer of <camera> and <noise>."""

from trundle.robots.model import EVERY_BIT, CameraOptics, Distortion, Lens, Noise

from ..tag import Tag


def add_camera(sensor: Tag, optics: CameraOptics) -> None:
    """Append <camera>."""
    camera = sensor.add("camera", name=optics.name) if optics.name else sensor.add("camera")
    camera.add_pose(optics.sensor_from_camera)
    camera.add("horizontal_fov", optics.horizontal_fov_rad)
    image, clip = camera.add("image"), camera.add("clip")
    image.add("width", optics.width_px)
    image.add("height", optics.height_px)
    image.add("format", optics.format)
    clip.add("near", optics.near_m)
    clip.add("far", optics.far_m)
    if optics.depth_near_m is not None or optics.depth_far_m is not None:
        depth = camera.add("depth_camera").add("clip")
        depth.add("near", optics.near_m if optics.depth_near_m is None else optics.depth_near_m)
        depth.add("far", optics.far_m if optics.depth_far_m is None else optics.depth_far_m)
    if optics.save_path is not None:
        camera.add("save", enabled="true").add("path", optics.save_path)
    if optics.panoptic:
        camera.add("segmentation_type", "instance")
    camera.add_unless("box_type", optics.box_type, default="2d")
    camera.add_unless("visibility_mask", optics.visibility_mask, default=EVERY_BIT)
    camera.add_unless("triggered", optics.triggered, default=False)
    camera.add_unless("trigger_topic", optics.trigger_topic, default="")
    camera.add_unless("camera_info_topic", optics.info_topic, default="")
    camera.add_unless("optical_frame_id", optics.optical_frame, default="")
    add_noise(camera, optics.noise)
    _add_distortion(camera, optics.distortion)
    _add_lens(camera.add_optional("lens"), optics)


def _add_distortion(camera: Tag, distortion: Distortion) -> None:
    if distortion == Distortion():
        return
    tag = camera.add("distortion")
    for name in ("k1", "k2", "k3", "p1", "p2"):
        tag.add(name, getattr(distortion, name))
    tag.add("center", distortion.center)


def _add_lens(tag: Tag, optics: CameraOptics) -> None:
    if optics.lens is not None:
        _add_wide(tag, optics.lens)
    if optics.intrinsics is not None:
        pinhole = optics.intrinsics
        intrinsics = tag.add("intrinsics")
        for name, value in (("fx", pinhole.fx), ("fy", pinhole.fy), ("cx", pinhole.cx), ("cy", pinhole.cy)):
            intrinsics.add(name, value)
        intrinsics.add("s", pinhole.skew)
    if optics.projection is not None:
        p = optics.projection
        projection = tag.add("projection")
        for name, value in (("p_fx", p.fx), ("p_fy", p.fy), ("p_cx", p.cx), ("p_cy", p.cy)):
            projection.add(name, value)
        projection.add("tx", p.tx)
        projection.add("ty", p.ty)


def _add_wide(tag: Tag, lens: Lens) -> None:
    """Append a lens, always as a custom one."""
    tag.add("type", "custom")
    tag.add("scale_to_hfov", lens.scale_to_hfov)
    function = tag.add("custom_function")
    for name in ("c1", "c2", "c3", "f", "fun"):
        function.add(name, getattr(lens, name))
    tag.add("cutoff_angle", lens.cutoff_rad)
    tag.add("env_texture_size", lens.face_px)


def add_noise(home: Tag, noise: Noise) -> None:
    """Append <noise>, unless it is zero."""
    if noise == Noise():
        return
    tag = home.add("noise", type="gaussian")
    tag.add("mean", noise.mean)
    tag.add("stddev", noise.stddev)
    tag.add_unless("bias_mean", noise.bias_mean, default=0.0)
    tag.add_unless("bias_stddev", noise.bias_stddev, default=0.0)
    tag.add_unless("dynamic_bias_stddev", noise.wander_density, default=0.0)
    tag.add_unless("dynamic_bias_correlation_time", noise.wander_time_s, default=0.0)
    tag.add_unless("precision", noise.precision, default=0.0)
