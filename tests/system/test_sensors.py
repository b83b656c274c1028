"""Topics of a ray sensor, an IMU, a GPS and a contact sensor."""

from pathlib import Path

WORLD = """<sdf version="1.6"><world name="w"><model name="box"><static>1</static><pose>2 0 0 0 0 0</pose>
<link name="l"><collision name="c"><geometry><box><size>1 4 4</size></box></geometry></collision></link></model>
<model name="m"><static>1</static><link name="a">
<sensor name="laser" type="ray"><update_rate>20</update_rate><ray><scan><horizontal><samples>3</samples>
<min_angle>-0.1</min_angle><max_angle>0.1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range></ray>
</sensor><sensor name="imu" type="imu"><update_rate>50</update_rate></sensor>
<sensor name="gps" type="gps"/></link></model>
<model name="block"><pose>2 0 2.5 0 0 0</pose><link name="l"><collision name="c"><geometry><box><size>1 1 1</size></box>
</geometry></collision><sensor name="bumper" type="contact"/></link></model></world></sdf>"""


def test_sensor_messages_have_existing_frames(start, master, until, trundle, tmp_path) -> None:
    file = Path(tmp_path) / "w.sdf"
    file.write_text(WORLD)
    start("run", str(file), "--headless")
    until("the topics", lambda: {"/m/a/laser/scan", "/m/a/imu/imu"} <= set(dict(master.call("getTopicTypes"))))

    scan = trundle("topic", "echo", "-n1", "/m/a/laser/scan").stdout
    imu = trundle("topic", "echo", "-n1", "/m/a/imu/imu").stdout

    assert 'frame_id: "m/laser"' in scan
    assert "ranges: [1.507" in scan
    assert ", 1.5, " in scan
    assert 'frame_id: "m/imu"' in imu
    assert "z: 9.8" in imu
    assert "latitude: 0.0" in trundle("topic", "echo", "-n1", "/m/a/gps/fix").stdout
    touched = trundle("topic", "echo", "-n1", "/block/l/bumper/contacts").stdout
    assert 'collision1_name: "block::l::c"' in touched
    assert 'collision2_name: "box::l::c"' in touched
    frames = trundle("topic", "echo", "-n1", "/tf_static").stdout
    assert 'child_frame_id: "m/laser"' in frames
