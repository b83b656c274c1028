/** A planar arm of two turning joints and a sliding finger, as its parameters describe it. */

export const URDF = `<robot name="arm">
  <link name="base"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
  <link name="upper"><visual><geometry><box size="1 0.1 0.1"/></geometry></visual></link>
  <link name="lower"><visual><geometry><box size="1 0.1 0.1"/></geometry></visual></link>
  <link name="tip"/>
  <link name="finger"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
  <link name="thumb"/>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/><limit lower="-2" upper="1.5"/>
  </joint>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="wrist" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint>
  <joint name="grip" type="prismatic">
    <parent link="tip"/><child link="finger"/><axis xyz="1 0 0"/><limit lower="0.01" upper="0.05"/>
  </joint>
  <joint name="grip2" type="prismatic">
    <parent link="tip"/><child link="thumb"/><axis xyz="-1 0 0"/><limit lower="0" upper="0.1"/>
    <mimic joint="grip" multiplier="2" offset="0.01"/>
  </joint>
</robot>`;

export const SRDF = `<robot name="arm">
  <virtual_joint name="world_joint" type="fixed" parent_frame="world" child_link="base"/>
  <group name="arm"><chain base_link="base" tip_link="tip"/></group>
  <group name="hand"><link name="finger"/><link name="thumb"/></group>
  <group name="all"><group name="arm"/><group name="hand"/></group>
  <group_state name="home" group="arm"><joint name="shoulder" value="0.5"/><joint name="elbow" value="-1"/></group_state>
  <end_effector name="gripper" parent_link="tip" group="hand" parent_group="arm"/>
</robot>`;
