#include "camera/camera_model.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "anthrob_core/config_node.h"

namespace anthrob {
namespace mocap {

namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

std::vector<double> matrix(const ConfigNode& parent, const std::string& key, int rows, int cols) {
  const ConfigNode node = parent.at(key);
  node.at("rows").as_integer(rows, rows);
  node.at("cols").as_integer(cols, cols);
  const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols);
  return node.at("data").as_numbers(count, "pixel or 1");
}

void read_distortion(const ConfigNode& file, CameraModel& camera) {
  const std::string model = file.text_or("distortion_model", "plumb_bob");
  if (model != "plumb_bob" && model != "rational_polynomial") {
    file.at("distortion_model").fail_expected("plumb_bob or rational_polynomial");
  }
  const ConfigNode data = file.at("distortion_coefficients").at("data");
  const std::size_t count = data.items().size();
  if (!is_distortion_count(count)) data.fail_expected("4, 5 or 8 numbers");
  const std::vector<double> values = data.as_numbers(count, "1");
  std::copy(values.begin(), values.end(), camera.distortion.begin());
}

}  // namespace

// All comparisons are such that a NaN is refused.

std::optional<std::string> camera_matrix_fault(const Mat3& K, int width, int height) {
  const auto is_one = [](const Mat3& M) {
    return M(0, 0) > 0.0 && M(1, 1) > 0.0 && M(0, 1) == 0.0 && M(1, 0) == 0.0 &&
           M.row(2) == Eigen::RowVector3d(0.0, 0.0, 1.0) && M.allFinite();
  };
  if (!is_one(K)) {
    return std::string("expected [fx, 0, cx, 0, fy, cy, 0, 0, 1] with fx, fy > 0") +
           (is_one(K.transpose()) ? "; this one is written column by column" : "");
  }
  if (!(K(0, 2) > 0.0 && K(0, 2) < width && K(1, 2) > 0.0 && K(1, 2) < height)) {
    return "expected a principal point (cx, cy) in the picture of " + std::to_string(width) +
           " x " + std::to_string(height) + " pixels";
  }
  return std::nullopt;
}

bool is_rotation(const Mat3& R) {
  // A mirrored calibration keeps all distances; only the determinant shows it.
  return (R * R.transpose() - Mat3::Identity()).norm() < 1e-4 && R.determinant() > 0.0;
}

bool is_rectified(const CameraModel::Projection& P) {
  return P(0, 0) > 0.0 && std::abs(P(0, 0) - P(1, 1)) <= 1e-6 * P(0, 0) && P(0, 1) == 0.0 &&
         P(1, 0) == 0.0 && P.row(2) == Eigen::RowVector4d(0.0, 0.0, 1.0, 0.0) && P.allFinite();
}

bool is_distortion_count(std::size_t coefficients) {
  return coefficients == 4 || coefficients == 5 || coefficients == 8;
}

CameraModel CameraModel::load(const std::string& path) {
  const ConfigNode file = ConfigNode::load(path);
  CameraModel camera;
  camera.width = file.at("image_width").as_integer(1, 100000);
  camera.height = file.at("image_height").as_integer(1, 100000);
  camera.name = file.text_or("camera_name", "camera");
  const std::vector<double> K = matrix(file, "camera_matrix", 3, 3);
  camera.fx = K[0], camera.cx = K[2], camera.fy = K[4], camera.cy = K[5];
  const Mat3 matrix_of_file = Eigen::Map<const RowMajor3>(K.data());
  if (const auto fault = camera_matrix_fault(matrix_of_file, camera.width, camera.height)) {
    file.at("camera_matrix").fail(*fault);
  }
  read_distortion(file, camera);
  const std::vector<double> R = matrix(file, "rectification_matrix", 3, 3);
  camera.R = Eigen::Map<const RowMajor3>(R.data());
  if (!is_rotation(camera.R)) {
    file.at("rectification_matrix")
        .fail("expected a rotation; this one is " +
              std::string(is_rotation(-camera.R) ? "mirrored" : "not orthonormal"));
  }
  const std::vector<double> P = matrix(file, "projection_matrix", 3, 4);
  camera.P = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(P.data());
  if (!is_rectified(camera.P)) {
    file.at("projection_matrix").fail("expected a rectified camera [f, 0, cx, Tx, 0, f, cy, ...]");
  }
  return camera;
}

namespace {

template <typename Matrix>
void write_matrix(std::ostream& out, const std::string& key, const Matrix& values) {
  out << key << ":\n  rows: " << values.rows() << "\n  cols: " << values.cols() << "\n  data: [";
  for (int i = 0; i < values.rows(); ++i) {
    for (int j = 0; j < values.cols(); ++j) out << (i + j > 0 ? ", " : "") << values(i, j);
  }
  out << "]\n";
}

}  // namespace

std::string CameraModel::to_yaml() const {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  Mat3 K;
  K << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  const bool rational = distortion[5] != 0.0 || distortion[6] != 0.0 || distortion[7] != 0.0;
  Eigen::RowVectorXd D(rational ? 8 : 5);
  for (int i = 0; i < D.size(); ++i) D[i] = distortion[static_cast<std::size_t>(i)];
  out << "image_width: " << width << "\nimage_height: " << height << "\ncamera_name: " << name
      << "\n";
  write_matrix(out, "camera_matrix", K);
  out << "distortion_model: " << (rational ? "rational_polynomial" : "plumb_bob") << "\n";
  write_matrix(out, "distortion_coefficients", D);
  write_matrix(out, "rectification_matrix", R);
  write_matrix(out, "projection_matrix", P);
  return out.str();
}

Vec2 CameraModel::distort(const Vec2& ideal) const {
  const auto& k = distortion;
  const double x = ideal.x(), y = ideal.y(), xy = x * y, r2 = x * x + y * y;
  const double radial =
      (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  return {x * radial + 2.0 * k[2] * xy + k[3] * (r2 + 2.0 * x * x),
          y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * xy};
}

Vec2 CameraModel::undistort(const Vec2& distorted) const {
  // distort(x) = x + small: iterating x <- x - (distort(x) - target) contracts for real lenses.
  Vec2 x = distorted;
  for (int i = 0; i < 100; ++i) {
    const Vec2 miss = distort(x) - distorted;
    x -= miss;
    if (miss.squaredNorm() < 1e-24) return x;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan};
}

Vec2 CameraModel::project(const Vec3& p_C) const {
  const Vec2 d = distort({p_C.x() / p_C.z(), p_C.y() / p_C.z()});
  return {fx * d.x() + cx, fy * d.y() + cy};
}

Vec2 CameraModel::ideal(const Vec2& pixel) const {
  return undistort({(pixel.x() - cx) / fx, (pixel.y() - cy) / fy});
}

}  // namespace mocap
}  // namespace anthrob
