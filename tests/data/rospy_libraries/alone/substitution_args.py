"""Substitution args resolved by programs that read roslaunch-like files of their own."""

import os

from roslaunch.substitution_args import ArgException, SubstitutionException, resolve_args

os.environ["COLOUR"] = "red"
os.environ.pop("NOT_SET", None)
context = {"arg": {"speed": "1.5", "name": "rover", "on": "true", "empty": ""}, "filename": "/tmp/launch/robot.launch"}
for text in (
    None, "", "plain", "$", "$HOME", "a $(arg name) b $(arg speed)", "$(arg empty)", "$(env COLOUR)/$(optenv COLOUR blue)",
    "$(optenv NOT_SET)", "$(optenv NOT_SET two words)", "$(dirname)/x", "$$(arg name)", "( $(arg name) )", "$( arg name )",
    "$(eval 1 + 2)", "$(eval arg('speed') * 2)", "$(eval speed + 0.5)", "$(eval on and name)", "$(eval env('COLOUR'))",
    "$(eval optenv('NOT_SET', 'x'))", "$(eval pi > 3)", "$(eval 'a' if on else 'b')", "$(eval dirname())", "x $(eval 1)",
    "$(eval int(speed))", "$(eval name.__class__)", "$(arg nothing)", "$(env NOT_SET)", "$(nothing x)", "$(arg a b)",
    "$(arg)", "$(arg $(arg name))", "$(eval arg('nothing'))",
):  # fmt: skip
    try:
        print(repr(text), repr(resolve_args(text, context)))
    except ArgException as error:
        print(repr(text), "ArgException", error)
    except SubstitutionException:
        print(repr(text), "SubstitutionException")
one, again = resolve_args("$(anon cam)", context), resolve_args("$(anon cam)", context)
print(one == again, one.startswith("cam_"), resolve_args("$(anon cam)") == one, "anon" in context)
try:
    resolve_args("$(dirname)")
except SubstitutionException as error:
    print(error)
