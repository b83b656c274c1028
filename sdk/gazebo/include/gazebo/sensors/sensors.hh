#error \
    "Trundle's kit has no sensor plugins in C++: the sensor's plugin of gazebo_ros publishes its readings, and a node reads them"
