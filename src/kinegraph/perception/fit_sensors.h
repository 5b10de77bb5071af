#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/perception/pose_fit.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline perception_internal {

/// Estimates the poses of cameras and the offsets of joints from depth images of a scene.
///
/// The squared distances of measured points from the surfaces of all shapes of the scene, and of the things seen, are
/// minimized with robust weights. Gaussian priors hold what the images do not determine. The variables are six
/// displacements of each camera, the offset of each active hinge and slide that is not one of a thing, and the poses of
/// the things.
class SensorFit {
 public:
  /// Corrects the cameras and joints of `config`, which has to live as long as this object. Throws ValueError if there
  /// is no joint to be estimated, and for a camera frame with a joint of its own.
  SensorFit(Config& config, std::span<const DepthView> views, const std::vector<std::string>& things,
            const RegisterOptions& options);

  /// Fits the sensors, and with them the things that were seen.
  void fit(const SeenScene& seen);

  /// Adds the estimates, their covariance and warnings, and to the covariance of things what the sensors contribute.
  void describe(SeenScene& seen) const;

  /// Corrects the cameras and joints of another copy of the scene.
  void correct(Config& config) const;

  const std::vector<DepthView>& views() const { return views_; }  ///< with corrected poses

 private:
  struct Point {  // measured
    Vector3d c;   ///< in the camera, m
    double sigma;
    int view;
  };
  struct Body {  // a rigid part of the scene, or a thing
    VisibleShape shape;
    int frame;
    RigidTransform X = {};
    std::vector<EyeInParts> eyes = {};  ///< of each view
    std::string thing = {};             ///< its name
    PoseFreedom freedom = {};
    int first_variable = -1;  ///< of a thing
  };
  struct Camera {
    int frame;  ///< -1: a pose in the world
    int view;   ///< the first one
  };
  struct Dof {
    int index;  ///< in q
    std::string name;
    double deviation;  ///< of the prior, rad or m
  };
  struct Contact {  // of a point with the nearest body
    const Body* body = nullptr;
    SurfaceDistance near = {};
  };
  struct Equations {
    MatrixXd H;                   ///< J^T W J
    VectorXd g;                   ///< J^T W r
    std::vector<VectorXd> pulls;  ///< of an error common to the pixels of a view
    double residuals = 0.;        ///< weighted sum of squares
    int count = 0;
  };

  int sensorVariables() const { return 6 * int(cameras_.size()) + int(dofs_.size()); }
  int variables() const;
  void addCameras();
  void addDofs(const std::set<int>& things);
  void addPoints();
  void addBodies(const std::set<int>& things);
  void addThings(const SeenScene& seen);
  void place();
  Contact contactOf(const Vector3d& p, int view, double reach) const;
  VectorXd row(const Body& body, const Point& point, const Vector3d& p, const Vector3d& normal) const;
  Equations equations(double width, bool inliers_only) const;
  void move(const VectorXd& step);
  VectorXd priors() const;
  void addWarnings(const MatrixXd& covariance, std::vector<std::string>& warnings) const;

  Config& config_;
  std::vector<DepthView> views_;
  std::vector<std::string> things_;
  bool may_rest_;
  std::vector<Point> points_;
  std::vector<Camera> cameras_;
  std::vector<int> camera_of_view_;  ///< -1: not estimated
  std::vector<int> frame_of_view_;   ///< -1: a pose in the world
  std::vector<Dof> dofs_;
  std::vector<Body> bodies_;
  std::size_t parts_ = 0;             ///< number of bodies before the things
  std::vector<RigidTransform> eyes_;  ///< X_WC of each view
  VectorXd moved_;                    ///< of the sensors so far, as in their covariance
};

}  // namespace kinegraph::inline perception_internal
