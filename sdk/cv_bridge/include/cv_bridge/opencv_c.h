// Names of OpenCV before 4 that sources use: of its C headers, which OpenCV 4 has but no longer includes by itself.
#pragma once

#if defined(__has_include)
#if __has_include(<opencv2/core/core_c.h>)
#include <opencv2/core/core_c.h>  // cvPoint, cvGetTickCount, CV_RGB
#endif
#if __has_include(<opencv2/imgproc/imgproc_c.h>)
#include <opencv2/imgproc/imgproc_c.h>  // CV_AA, CV_BGR2HSV, CV_FONT_HERSHEY_COMPLEX
#endif
#if __has_include(<opencv2/imgcodecs/legacy/constants_c.h>)
#include <opencv2/imgcodecs/legacy/constants_c.h>  // CV_LOAD_IMAGE_COLOR
#endif
#if __has_include(<opencv2/videoio/legacy/constants_c.h>)
#include <opencv2/videoio/legacy/constants_c.h>  // CV_CAP_PROP_FRAME_WIDTH
#endif
#if __has_include(<opencv2/highgui/highgui_c.h>)
#include <opencv2/highgui/highgui_c.h>  // CV_WINDOW_AUTOSIZE, cvStartWindowThread
#endif
#endif

// Of objdetect, whose C header is gone.
#ifndef CV_HAAR_DO_CANNY_PRUNING
#define CV_HAAR_DO_CANNY_PRUNING 1
#define CV_HAAR_SCALE_IMAGE 2
#define CV_HAAR_FIND_BIGGEST_OBJECT 4
#define CV_HAAR_DO_ROUGH_SEARCH 8
#endif
