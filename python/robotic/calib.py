"""Calibration of cameras and robots from pictures of markers."""

from .pending import pending

_OPENCV = "OpenCV's cv2.aruco and cv2.calibrateCamera do the same"
calibrate_intrinsics = pending("calib.calibrate_intrinsics", _OPENCV)
detect_arucos = pending("calib.detect_arucos", _OPENCV)
undistort_images = pending("calib.undistort_images", _OPENCV)
komo_calibrate = pending("calib.komo_calibrate", "KOMO with addFrameDof(..., stable=True) states the same problem")
render_images = pending("calib.render_images", "CameraView.computeImageAndDepth renders pictures one by one")
