"""Writer of <visual> and <collision>."""

from trundle.robots.model import (
    EVERY_BIT,
    GREY,
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Material,
    MeshFile,
    Plane,
    Polyline,
    Sphere,
    Surface,
    Visual,
)

from ..files import UriOf
from ..tag import Tag


def add_visual(link: Tag, visual: Visual, uri_of: UriOf) -> None:
    """Append <visual>."""
    tag = link.add("visual", name=visual.name)
    tag.add_pose(visual.link_from_visual)
    add_geometry(tag, visual.geometry, uri_of)
    if visual.material != GREY:
        add_material(tag, visual.material, uri_of)
    tag.add_unless("transparency", visual.transparency, default=0.0)
    tag.add_unless("cast_shadows", visual.cast_shadows, default=True)
    tag.add_unless("laser_retro", visual.laser_retro, default=0.0)
    tag.add_unless("visibility_flags", visual.visibility_flags, default=EVERY_BIT)
    if visual.label:
        plugin = tag.add("plugin", filename="gz-sim-label-system", name="gz::sim::systems::Label")
        plugin.add("label", visual.label)
    if visual.temperature is not None:
        plugin = tag.add("plugin", filename="gz-sim-thermal-system", name="gz::sim::systems::Thermal")
        plugin.add("temperature", visual.temperature)
    tag.children += [plugin.node.xml() for plugin in visual.plugins]


def add_collision(link: Tag, collision: Collision, uri_of: UriOf) -> None:
    """Append <collision>."""
    tag = link.add("collision", name=collision.name)
    tag.add_pose(collision.link_from_collision)
    add_geometry(tag, collision.geometry, uri_of)
    tag.add_unless("laser_retro", collision.laser_retro, default=0.0)
    tag.add_unless("max_contacts", collision.max_contacts, default=10)
    add_surface(tag, collision.surface)


def add_geometry(home: Tag, geometry: Geometry, uri_of: UriOf) -> None:
    """Append <geometry>."""
    tag = home.add("geometry")
    match geometry:
        case Box(size):
            tag.add("box").add("size", size)
        case Cylinder(radius, length) | Capsule(radius, length) | Cone(radius, length):
            shape = tag.add(type(geometry).__name__.lower())
            shape.add("radius", radius)
            shape.add("length", length)
        case Sphere(radius):
            tag.add("sphere").add("radius", radius)
        case Ellipsoid(radii):
            tag.add("ellipsoid").add("radii", radii)
        case Plane(normal, size):
            shape = tag.add("plane")
            shape.add("normal", normal)
            shape.add("size", size)
        case Polyline(outlines, height):
            for outline in outlines:
                shape = tag.add("polyline")
                for corner in outline:
                    shape.add("point", corner)
                shape.add("height", height)
        case Heightmap():
            shape = tag.add("heightmap")
            shape.add("uri", uri_of(geometry.path, geometry.uri))
            shape.add("size", geometry.size)
            shape.add("pos", geometry.position)
            for layer in geometry.layers:
                texture = shape.add("texture")
                texture.add("size", layer.size)
                texture.add("diffuse", uri_of(layer.diffuse, ""))
                texture.add("normal", uri_of(layer.normal, ""))
            for layer in geometry.layers[1:]:
                blend = shape.add("blend")
                blend.add("min_height", layer.from_height)
                blend.add("fade_dist", layer.fade)
            shape.add("sampling", geometry.sampling)
        case MeshFile():
            shape = tag.add("mesh")
            shape.add("uri", uri_of(geometry.path, geometry.uri))
            shape.add_unless("scale", geometry.scale, default=(1.0, 1.0, 1.0))
            if geometry.submesh is not None:
                part = shape.add("submesh")
                part.add("name", geometry.submesh)
                part.add("center", geometry.center_submesh)
        case Empty():
            tag.add("empty")


def add_material(home: Tag, material: Material, uri_of: UriOf) -> None:
    """Append <material>."""
    tag = home.add("material")
    if material.named_texture is not None:
        script = tag.add("script")
        script.add("uri", "file://media/materials/scripts/gazebo.material")
        script.add("name", material.named_texture)
    for name in ("ambient", "diffuse", "specular", "emissive"):
        tag.add(name, getattr(material, name))
    if material.texture is not None:
        tag.add("pbr").add("metal").add("albedo_map", uri_of(material.texture, ""))


def add_surface(home: Tag, surface: Surface) -> None:
    """Append <surface>, unless it is the default."""
    tag, default = home.add_optional("surface"), Surface()
    friction = tag.add_optional("friction")
    ode = friction.add_optional("ode")
    for name in ("mu", "mu2", "fdir1", "slip1", "slip2"):
        ode.add_unless(name, getattr(surface, name), default=getattr(default, name))
    torsional = friction.add_optional("torsional")
    torsional.add_unless("coefficient", surface.torsional_coefficient, default=default.torsional_coefficient)
    for name in ("patch_radius", "surface_radius", "use_patch_radius"):
        torsional.add_unless(name, getattr(surface, name), default=getattr(default, name))
    torsional.add_optional("ode").add_unless("slip", surface.torsional_slip, default=default.torsional_slip)
    contact = tag.add_optional("contact")
    contact.add_unless("collide_bitmask", surface.collide_bitmask, default=default.collide_bitmask)
    contact.add_unless("category_bitmask", surface.category_bitmask, default=default.category_bitmask)
    contact.add_unless("collide_without_contact", surface.collide_without_contact, default=False)
    ode = contact.add_optional("ode")
    for name in ("kp", "kd", "min_depth", "max_vel"):
        ode.add_unless(name, getattr(surface, name), default=getattr(default, name))
    bounce = tag.add_optional("bounce")
    bounce.add_unless("restitution_coefficient", surface.restitution, default=default.restitution)
    bounce.add_unless("threshold", surface.bounce_threshold, default=default.bounce_threshold)
