/** Imports every display, which registers it. */

/** Imports every display, which registers it. */
import "./accel_stamped";
import "./axes";
import "./camera";
import "./depth_cloud";
import "./effort";
import "./fluid_pressure";
import "./grid";
import "./grid_cells";
import "./group";
import "./illuminance";
import "./image";
import "./imu";
import "./interactive_markers";
import "./laser_scan";
import "./map";
import "./marker";
import "./odometry";
import "./path";
import "./point_cloud";
import "./point_cloud2";
import "./point_stamped";
import "./polygon";
import "./pose";
import "./pose_array";
import "./pose_with_covariance";
import "./range";
import "./relative_humidity";
import "./robot_model";
import "./temperature";
import "./tf";
import "./twist_stamped";
import "./wrench_stamped";
