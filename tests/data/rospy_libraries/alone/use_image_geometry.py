"""image_geometry: projection, binning, regions of interest, rectification of points, stereo."""

from sensor_msgs.msg import CameraInfo, RegionOfInterest

from image_geometry import PinholeCameraModel, StereoCameraModel

info = CameraInfo(width=640, height=480)
info.header.frame_id = "eye"
info.K = [530.0, 0, 320.5, 0, 525.0, 240.5, 0, 0, 1]
info.D = [-0.28, 0.07, 0.001, -0.0005, 0.01]
info.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
info.P = [500.0, 0, 318.0, 0, 0, 498.0, 241.0, 0, 0, 0, 1, 0]


def r(values):
    """Rounded."""
    return [round(float(v), 4) + 0.0 for v in values]


for binning, roi in ((0, RegionOfInterest()), (2, RegionOfInterest(x_offset=10, y_offset=20, width=300, height=200))):
    info.binning_x = info.binning_y = binning
    info.roi = roi
    m = PinholeCameraModel()
    m.fromCameraInfo(info)
    print(
        r(m.project3dToPixel((0.1, -0.2, 2))),
        r(m.project3dToPixel((0.1, -0.2, 0))),
        r(m.projectPixelTo3dRay((10, 400))),
    )
    print(r((m.fx(), m.fy(), m.cx(), m.cy(), m.Tx(), m.Ty(), m.fovX(), m.fovY())), m.tfFrame(), m.fullResolution())
    print(r((m.getDeltaU(0.1, 2), m.getDeltaV(0.1, 2), m.getDeltaX(5, 2), m.getDeltaY(5, 2))), m.getDeltaU(1, 0))
    for matrix in (
        m.intrinsicMatrix(),
        m.rotationMatrix(),
        m.projectionMatrix(),
        m.fullIntrinsicMatrix(),
        m.distortionCoeffs(),
    ):
        print(type(matrix).__name__, matrix.shape, r(matrix.ravel().tolist()[0]))
    print(m.fullProjectionMatrix().shape, m.raw_roi.width, m.raw_roi.height)
right = CameraInfo(width=640, height=480, K=info.K, R=info.R)
right.P = [500.0, 0, 318.0, -60.0, 0, 498.0, 241.0, 0, 0, 0, 1, 0]
info.binning_x = info.binning_y = 0
info.roi = RegionOfInterest()
s = StereoCameraModel()
s.fromCameraInfo(info, right)
print([r(uv) for uv in s.project3dToPixel((0.3, 0.2, 3.0))], r(s.projectPixelTo3d((368, 274.2), 20.0)))
print(s.getZ(20), s.getDisparity(3.0), s.getZ(0), s.getDisparity(0), s.tfFrame(), s.projectPixelTo3d((1, 2), 0))
none = PinholeCameraModel()
none.fromCameraInfo(right)
print(none.distortionCoeffs())
