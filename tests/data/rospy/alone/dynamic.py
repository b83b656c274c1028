import genpy.dynamic

TEXT = """# a comment
Header header
float32 X=1.5
string NAME=hello # world
Inner[] parts
uint8[3] three
time when
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
================================================================================
MSG: my_pkg/Inner
int8 A=-3
float64 value
string[] words
"""
found = genpy.dynamic.generate_dynamic("my_pkg/Outer", TEXT)
outer, inner = found["my_pkg/Outer"], found["my_pkg/Inner"]
print(sorted(found), outer._type, outer._md5sum, inner._md5sum, outer.__slots__, outer._slot_types)
print(outer.X, outer.NAME, inner.A, outer._has_header)
message = outer()
message.parts = [inner(value=2, words=["a"])]
print(message)
