/**
 * Convention of all 3D code: z is up. Imported before anything that makes a three.js object.
 *
 * Colors are three.js' usual: a `Color` is linear inside, and a flat color has its sRGB numbers on the screen. Shaders
 * of our own that shade with sRGB numbers, as Gazebo classic and rviz do, write them as they are.
 */

import { Object3D } from "three";

Object3D.DEFAULT_UP.set(0, 0, 1);
