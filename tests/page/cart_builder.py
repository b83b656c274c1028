"""User who builds a cart in the model editor, from nothing."""

from typing import Any

from tests.page.world_user import WorldUser

WHEEL_RADIUS = 0.1
WHEEL_SEPARATION = 0.36


class CartBuilder(WorldUser):
    """Clicks and types in the editor's tree, drawer and forms."""

    def draft(self) -> dict[str, Any] | None:
        return self.manifest().get("draft")

    def part(self, *path: str) -> dict[str, Any] | None:
        draft = self.draft()
        return None if draft is None else next((part for part in draft["parts"] if part["part"] == list(path)), None)

    def value(self, field: str, *path: str) -> Any:
        """Return the value of a part's field on the server."""
        part = self.part(*path)
        fields = [] if part is None else [item for section in part["sections"] for item in section["fields"]]
        return next((item["value"] for item in fields if item["name"] == field), None)

    def begin(self) -> None:
        self.button("World's menu").click()
        self.page.get_by_role("menuitem", name="New model…").click()
        self.page.get_by_role("tree", name="Model").wait_for()

    def choose(self, name: str) -> None:
        """Select a part in the tree."""
        row = self.page.get_by_role("tree", name="Model").get_by_role("treeitem")
        row.filter(has=self.page.get_by_text(name, exact=True)).first.click()
        self.page.locator(".ti .n").get_by_text(name, exact=True).wait_for()

    def add(self, tab: str, type_: str, name: str) -> None:
        """Add a part and wait until it is selected."""
        drawer = self.page.get_by_role("region", name="Add to the model")
        if not drawer.is_visible():
            self.button("Add").click()
        drawer.get_by_role("tab", name=tab).click()
        drawer.get_by_role("button", name=f"Add {type_}", exact=True).click()
        self.page.locator(".ti .n").get_by_text(name, exact=True).wait_for()

    def put(self, label: str, value: object, *, section: str | None = None) -> None:
        form = self.page.locator("aside.right")
        home = form if section is None else form.get_by_role("region", name=section, exact=True)
        field = home.get_by_label(label, exact=True)
        field.fill(str(value))
        field.press("Enter")

    def pick_choice(self, label: str, value: str) -> None:
        self.page.locator("aside.right").get_by_label(label, exact=True).select_option(value)

    def rename(self, name: str) -> None:
        self.put("Name", name)
        self.page.locator(".ti .n").get_by_text(name, exact=True).wait_for()

    def build(self) -> None:
        """Build a cart of a box, two driven wheels and a caster, with a lidar, a camera and a drive."""
        self.begin()
        self.rename("cart")
        self.add("Link", "box", "box")
        self.rename("chassis")
        for axis, size in zip("xyz", (0.5, 0.3, 0.1), strict=True):
            self.put(f"Size {axis} [m]", size)
        self.put("Pose z [m]", 0.12)
        self.put("Mass [kg]", 5)
        for side, y in (("left", WHEEL_SEPARATION / 2), ("right", -WHEEL_SEPARATION / 2)):
            self._add_wheel(side, y)
        self.add("Link", "sphere", "sphere")
        self.rename("caster")
        self.put("Radius [m]", 0.05)
        for label, number in (("Pose x [m]", -0.2), ("Pose z [m]", 0.05)):
            self.put(label, number)
        self.put("Mass [kg]", 0.2)
        self.put("mu", 0)
        self.put("mu2", 0)
        self.add("Joint", "fixed", "caster_joint")
        self.choose("chassis")
        self.add("Sensor", "ray", "lidar")
        self.put("Pose z [m]", 0.1)
        self.put("Samples", 180, section="Horizontal")
        self.choose("chassis")
        self.add("Sensor", "camera", "camera")
        self.put("Pose x [m]", 0.26)
        self.put("Width [px]", 160)
        self.put("Height [px]", 120)
        self.add("Plugin", "libgazebo_ros_diff_drive.so", "diff_drive")
        self.put("leftJoint", "left_wheel_joint")
        self.put("rightJoint", "right_wheel_joint")
        self.put("wheelSeparation", WHEEL_SEPARATION)
        self.put("wheelDiameter", 2 * WHEEL_RADIUS)
        self.put("robotBaseFrame", "chassis")

    def _add_wheel(self, side: str, y: float) -> None:
        self.add("Link", "cylinder", "cylinder")
        self.rename(f"{side}_wheel")
        self.put("Radius [m]", WHEEL_RADIUS)
        self.put("Length [m]", 0.04)
        for label, number in (("x [m]", 0.1), ("y [m]", y), ("z [m]", WHEEL_RADIUS), ("roll [°]", -90)):
            self.put(f"Pose {label}", number)
        self.put("Mass [kg]", 0.5)
        self.add("Joint", "continuous", f"{side}_wheel_joint")

    def save(self, folder: str) -> None:
        self.button("Save…").click()
        dialog = self.page.get_by_role("dialog", name="Save the model")
        dialog.get_by_label("Folder").fill(folder)
        dialog.get_by_role("button", name="Save", exact=True).click()
        self.page.get_by_role("status").get_by_text(f"saved in {folder}").wait_for()
