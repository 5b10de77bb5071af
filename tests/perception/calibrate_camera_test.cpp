#include "kinegraph/perception/calibrate_camera.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/perception/marker_poses.h"

namespace kinegraph {
namespace {

const Vector4d kPixels(600., 600., 320., 240.);

MatrixXd corners() {
  MatrixXd points(4, 3);
  points << -.03, -.03, 0., .03, -.03, 0., .03, .03, 0., -.03, .03, 0.;
  return points;
}

/// A camera that six joints move above a marker.
Config gantry() {
  Config C;
  C.addText(R"g(
    base: {}
    x(base): { joint: transX }
    y(x): { joint: transY }
    hand(y): { joint: hingeZ }
    tilt(hand): { pre: "t(0 0 .5)", joint: hingeX }
    roll(tilt): { joint: hingeY }
    cam(roll): { Q: "t(.02 .01 .03) d(175 1 .02 .03)" }
    marker: { X: "t(.1 .05 .02) d(20 .1 0 1)" }
  )g");
  return C;
}

MatrixXd pixelsAt(Config& C, const VectorXd& q) {
  C.setJointState(q);
  const Pose X_CM = C.getFrame("cam").getPose().inverse() * C.getFrame("marker").getPose();
  MatrixXd pixels(4, 2);
  for (int i = 0; i < 4; ++i) {
    const Vector3d p = X_CM.transform() * Vector3d(corners().row(i).transpose());
    pixels.row(i) << kPixels[0] * p.x() / p.z() + kPixels[2], kPixels[1] * p.y() / p.z() + kPixels[3];
  }
  return pixels;
}

MarkerImages drawImages(Config& C, int count, double spread, double noise) {
  Rng rng(5);
  MarkerImages images{corners(), kPixels, MatrixXd(count, 5), {}};
  for (int k = 0; k < count; ++k) {
    VectorXd q(5);
    for (double& x : q) x = spread * rng.normal();
    q.head<2>() *= .2;
    images.q.row(k) = q.transpose();
    images.pixels.push_back(pixelsAt(C, q));
    for (double& x : images.pixels.back().reshaped()) x += noise * rng.normal();
  }
  C.setJointState(VectorXd::Zero(5));
  return images;
}

TEST(CalibrateCamera, FindsBothPosesOfExactImagesFromAWrongStart) {
  Config C = gantry();
  const Pose camera = C.getFrame("cam").getRelativePose(), marker = C.getFrame("marker").getPose();
  const MarkerImages images = drawImages(C, 8, .4, 0.);
  C.getFrame("cam").setRelativePose(Pose());
  const CameraCalibration result = calibrateCamera(C, "cam", "marker", images);
  EXPECT_LT((result.camera.p - camera.p).norm(), 1e-6);
  EXPECT_LT(result.camera.q.angularDistance(camera.q), 1e-6);
  EXPECT_LT((result.marker.p - marker.p).norm(), 1e-6);
  EXPECT_LT((C.getFrame("cam").getRelativePose().p - camera.p).norm(), 1e-6);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.free_directions.rows(), 0);
}

TEST(CalibrateCamera, WithoutRotationsItWarnsAndNamesDirections) {
  Config C = gantry();
  MarkerImages images = drawImages(C, 8, .4, .1);
  images.q.rightCols<3>().setZero();
  for (int k = 0; k < 8; ++k) images.pixels[std::size_t(k)] = pixelsAt(C, images.q.row(k).transpose());
  const CameraCalibration result = calibrateCamera(C, "cam", "marker", images);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_GE(result.free_directions.rows(), 3);
}

TEST(CalibrateCamera, RefusesInvalidImages) {
  Config C = gantry();
  MarkerImages images = drawImages(C, 4, .4, 0.);
  EXPECT_THROW(calibrateCamera(C, "cam", "nothing", images), FrameNotFound);
  EXPECT_THROW(calibrateCamera(C, "cam", "marker", images, {-1., 0.}), ValueError);
  images.points *= 1000.;
  EXPECT_THROW(calibrateCamera(C, "cam", "marker", images), ValueError);
}

TEST(MarkerInCamera, IsThePoseOfThePlane) {
  Config C = gantry();
  const VectorXd q = VectorXd::Constant(5, .1);
  const auto found = markerInCamera(corners(), pixelsAt(C, q), kPixels);
  ASSERT_TRUE(found.has_value());
  const Pose expected = C.getFrame("cam").getPose().inverse() * C.getFrame("marker").getPose();
  EXPECT_LT((found->p - expected.p).norm(), 1e-8);
  EXPECT_LT((found->R - expected.transform().R).norm(), 1e-8);
}

}  // namespace
}  // namespace kinegraph
