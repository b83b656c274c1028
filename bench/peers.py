"""Results of other tools, measured in November 2026 on two noisy x86-64 cores without a GPU.

They were not measured in this run; compare only their ratios.
"""

TABLE = """
steps/s at 1 ms, one RP2W, no cameras   Gazebo 11 14,400 · MuJoCo by hand 117,000 · PyBullet 21,300 · Drake 22,600
  (ratios to MuJoCo by hand)            0.12 · 1 · 0.18 · 0.19
start to first step                     Gazebo 11 0.64 s · MuJoCo 0.31 s · PyBullet 0.14 s · Drake 0.6 s
320x240 images/s, two cameras summed    Gazebo 11 22 with shadows, 214 without · PyBullet 69 without · Drake 168
smartcar, roslaunch to first /odom      2.6 s; 351 MB over all nodes
rospy to rospy, Twist flat out          121,000 messages/s; Image 320x240 2,470 messages/s
"""
