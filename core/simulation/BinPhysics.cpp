// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinPhysics.h"

#include "base/PointGrid.h"
#include "mesh/FeatureEdges.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"
#include "simulation/MassProperties.h"
#include "simulation/PartContacts.h"

#include <algorithm>
#include <cmath>
#include <memory>

// Bullet's world has the part's diameter as its unit of length, and its unit of time is such that gravity is 10:
// the steps are as good for a screw as for a door.

namespace meam
{
namespace
{
constexpr double Gravity = 10.0;
constexpr double RealGravity = 9810.0; // mm/s^2
constexpr double Step = 1.0 / 250.0;
constexpr double CellSize = 0.009;    // of the distances
constexpr double ClosedSkin = 0.004;  // wider than what lies between two samples of the distances
constexpr double OpenSkin = 0.01;     // a sheet without thickness gets some
constexpr double FaceSpacing = 0.02;  // of points on faces
constexpr double EdgeSpacing = 0.006; // of points on sharp edges
constexpr double Clearance = 0.05;    // between a new copy and what lies in the bin
constexpr double MostSpeed = 4.0;     // nothing falls far enough to be faster for long
constexpr double MostSpin = 10.0;
constexpr double TimePerCopy = 0.6; // the next one falls then, or earlier when the last one has become slow
constexpr double SlowSpeed = 0.5;
constexpr double Damping = 0.2;    // share of the speed that is lost in a unit of time: what rolls comes to rest
constexpr double TimeToRest = 4.0; // after this the bin is calmed down
constexpr double TimeToCalm = 4.0;
constexpr double CalmDamping = 0.99;
constexpr double RestingSpeed = 0.02; // of the fastest point, for RestingTime
constexpr double RestingTime = 0.4;
constexpr int Tries = 200; // turns until one fits into the bin

/// A turn from three uniform numbers, each as likely as any other (K. Shoemake: Uniform Random Rotations, 1992).
Eigen::Quaterniond randomTurn(Random& random)
{
  const double share = random.uniform();
  const double a = 2.0 * M_PI * random.uniform();
  const double b = 2.0 * M_PI * random.uniform();
  return Eigen::Quaterniond(std::sqrt(share) * std::cos(b), std::sqrt(1.0 - share) * std::sin(a),
    std::sqrt(1.0 - share) * std::cos(a), std::sqrt(share) * std::sin(b));
}

/// The part as a shape, and its mass.
struct Part
{
  double diameter;
  MassProperties mass;
  std::unique_ptr<PartShape> shape;
};

Part makePart(const TriangleMesh& input)
{
  Part part;
  PreparedMesh prepared = prepareMesh(input);
  part.diameter = prepared.report.diameter;
  const bool closed = prepared.report.closed && prepared.report.volume > 1e-9 * std::pow(part.diameter, 3);
  TriangleMesh& mesh = prepared.mesh;
  part.mass = massProperties(mesh, closed);
  const Eigen::Isometry3d T_body_model = part.mass.T_model_body.inverse();
  for (Eigen::Vector3f& vertex : mesh.vertices)
  {
    vertex = (T_body_model * vertex.cast<double>() / part.diameter).cast<float>();
  }
  Points points = mesh.vertices;
  SurfaceSamplingSettings faces;
  faces.spacing = FaceSpacing;
  FeatureEdgesSettings edges;
  edges.spacing = EdgeSpacing;
  for (const Points& more : { sampleSurface(mesh, faces).points, extractFeatureEdges(mesh, edges).points })
  {
    points.insert(points.end(), more.begin(), more.end());
  }
  Points few; // a fine mesh has more vertices than are needed
  for (const int index : thinPoints(points, 0.5 * EdgeSpacing))
  {
    few.push_back(points[index]);
  }
  part.shape = std::make_unique<PartShape>(
    std::move(few), SignedDistanceGrid(mesh, closed, CellSize), closed ? ClosedSkin : OpenSkin);
  return part;
}

/// The bin and what has fallen into it.
class World
{
public:
  World(const Part& part, const Eigen::Vector2d& binSize)
    : Piece(part)
    , Size(binSize)
  {
    registerPartContacts(this->Dispatcher);
    this->Bullet.setGravity(btVector3(0.0, 0.0, -Gravity));
    btContactSolverInfo& solver = this->Bullet.getSolverInfo();
    solver.m_numIterations = 30;
    solver.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_USE_2_FRICTION_DIRECTIONS |
                          SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION | SOLVER_SIMD;
    solver.m_splitImpulse = 1;
    solver.m_splitImpulsePenetrationThreshold = -1e-4;
    this->Bullet.getDispatchInfo().m_deterministicOverlappingPairs = true;
    this->addWall({ 0.0, 0.0, 1.0 }, 0.0);
    for (const double side : { -1.0, 1.0 })
    {
      this->addWall({ side, 0.0, 0.0 }, -0.5 * binSize.x());
      this->addWall({ 0.0, side, 0.0 }, -0.5 * binSize.y());
    }
  }
  ~World()
  {
    for (const auto& body : this->Copies)
    {
      this->Bullet.removeRigidBody(body.get());
    }
    for (const auto& wall : this->Walls)
    {
      this->Bullet.removeRigidBody(wall.get());
    }
  }
  World(const World&) = delete;
  void operator=(const World&) = delete;

  /// A copy above all others.
  void add(Random& random)
  {
    double top = 0.0;
    btVector3 low;
    btVector3 high;
    for (const auto& body : this->Copies)
    {
      body->getAabb(low, high);
      top = std::max(top, high.z());
    }
    btTransform pose = btTransform::getIdentity();
    bool fits = false;
    for (int i = 0; i < Tries && !fits; ++i)
    {
      const Eigen::Quaterniond turn = randomTurn(random);
      pose.setRotation(btQuaternion(turn.x(), turn.y(), turn.z(), turn.w()));
      this->Piece.shape->getAabb(pose, low, high);
      fits = high.x() - low.x() < this->Size.x() && high.y() - low.y() < this->Size.y();
    }
    if (!fits)
    {
      throw Error("The part does not fit into the bin: make the bin larger.");
    }
    const Eigen::Vector2d half = 0.5 * this->Size;
    const double x = random.uniform(-half.x() - low.x(), half.x() - high.x());
    const double y = random.uniform(-half.y() - low.y(), half.y() - high.y());
    pose.setOrigin(btVector3(x, y, top + Clearance - low.z()));
    this->add(pose);
  }

  /// A copy at T_bin_model, mm.
  void add(const Eigen::Isometry3d& T_bin_model)
  {
    const Eigen::Isometry3d T_bin_body = T_bin_model * this->Piece.mass.T_model_body;
    const Eigen::Quaterniond turn(T_bin_body.linear());
    const Eigen::Vector3d place = T_bin_body.translation() / this->Piece.diameter;
    this->add(
      btTransform(btQuaternion(turn.x(), turn.y(), turn.z(), turn.w()), btVector3(place.x(), place.y(), place.z())));
  }

  void step()
  {
    for (const auto& body : this->Copies)
    {
      const auto limited = [](const btVector3& velocity, double most)
      { return velocity.length() > most ? velocity * (most / velocity.length()) : velocity; };
      body->setLinearVelocity(limited(body->getLinearVelocity(), MostSpeed));
      body->setAngularVelocity(limited(body->getAngularVelocity(), MostSpin));
    }
    this->Bullet.stepSimulation(Step, 0, Step);
  }

  void setDamping(double damping)
  {
    for (const auto& body : this->Copies)
    {
      body->setDamping(damping, damping);
    }
  }

  /// Of the fastest point of a copy.
  double speed(const btRigidBody& body) const
  {
    return body.getLinearVelocity().length() + this->Piece.shape->radius() * body.getAngularVelocity().length();
  }
  double speedOfLast() const { return this->speed(*this->Copies.back()); }
  double speed() const
  {
    double most = 0.0;
    for (const auto& body : this->Copies)
    {
      most = std::max(most, this->speed(*body));
    }
    return most;
  }

  /// T_bin_model of each copy, in mm.
  std::vector<Eigen::Isometry3d> poses() const
  {
    std::vector<Eigen::Isometry3d> result;
    for (const auto& body : this->Copies)
    {
      const btTransform& pose = body->getWorldTransform();
      const btQuaternion turn = pose.getRotation();
      Eigen::Isometry3d T_bin_body = Eigen::Isometry3d::Identity();
      T_bin_body.linear() = Eigen::Quaterniond(turn.w(), turn.x(), turn.y(), turn.z()).normalized().matrix();
      T_bin_body.translation() << pose.getOrigin().x(), pose.getOrigin().y(), pose.getOrigin().z();
      T_bin_body.translation() *= this->Piece.diameter;
      result.push_back(T_bin_body * this->Piece.mass.T_model_body.inverse());
    }
    return result;
  }

private:
  void add(const btTransform& pose)
  {
    const Eigen::Vector3d inertia = this->Piece.mass.inertia / (this->Piece.diameter * this->Piece.diameter);
    btRigidBody::btRigidBodyConstructionInfo info(
      1.0, nullptr, this->Piece.shape.get(), btVector3(inertia.x(), inertia.y(), inertia.z()));
    info.m_startWorldTransform = pose;
    this->Copies.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& body = *this->Copies.back();
    body.setDamping(Damping, Damping);
    this->Bullet.addRigidBody(&body);
  }

  void addWall(const btVector3& normal, double constant)
  {
    this->WallShapes.push_back(std::make_unique<btStaticPlaneShape>(normal, constant));
    this->Walls.push_back(std::make_unique<btRigidBody>(
      btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, this->WallShapes.back().get())));
    this->Bullet.addRigidBody(this->Walls.back().get());
  }

  const Part& Piece;
  Eigen::Vector2d Size;
  btDefaultCollisionConfiguration Configuration;
  btCollisionDispatcher Dispatcher{ &this->Configuration };
  btDbvtBroadphase Broadphase;
  btSequentialImpulseConstraintSolver Solver;
  btDiscreteDynamicsWorld Bullet{ &this->Dispatcher, &this->Broadphase, &this->Solver, &this->Configuration };
  std::vector<std::unique_ptr<btStaticPlaneShape>> WallShapes;
  std::vector<std::unique_ptr<btRigidBody>> Walls;
  std::vector<std::unique_ptr<btRigidBody>> Copies;
};
}

namespace
{
/// Brings the world on, step by step, until the copies rest or time runs out.
template <typename Advance>
FilledBin rested(World& world, const Part& part, Advance&& advance)
{
  double resting = 0.0;
  for (double time = 0.0; time < TimeToRest + TimeToCalm && resting < RestingTime; time += Step)
  {
    if (time > TimeToRest)
    {
      world.setDamping(CalmDamping);
    }
    advance();
    resting = world.speed() < RestingSpeed ? resting + Step : 0.0;
  }
  // One unit of time in seconds.
  const double second = std::sqrt(part.diameter * Gravity / RealGravity);
  return { world.poses(), world.speed() * part.diameter / second };
}
}

FilledBin fillBin(
  const TriangleMesh& input, const Eigen::Vector2d& binSize, int copies, Random& random, const Progress& progress)
{
  const Part part = makePart(input);
  report(progress, 0.05);
  World world(part, binSize / part.diameter);
  const double last = TimePerCopy * copies + TimeToRest + TimeToCalm;
  double now = 0.0;
  const auto step = [&]
  {
    world.step();
    now += Step;
    report(progress, 0.05 + 0.95 * std::min(now / last, 1.0));
  };
  for (int copy = 0; copy < copies; ++copy)
  {
    now = TimePerCopy * copy;
    world.add(random);
    const double next = now + TimePerCopy;
    // The new one starts slowly, too.
    for (double start = now; now < next && (now < start + 0.5 * TimePerCopy || world.speedOfLast() > SlowSpeed);)
    {
      step();
    }
  }
  now = last - TimeToRest - TimeToCalm;
  FilledBin filled = rested(world, part, step);
  report(progress, 1.0);
  return filled;
}

FilledBin settleBin(const TriangleMesh& input, const Eigen::Vector2d& binSize,
  const std::vector<Eigen::Isometry3d>& poses, const Progress& progress)
{
  const Part part = makePart(input);
  report(progress, 0.05);
  World world(part, binSize / part.diameter);
  for (const auto& pose : poses)
  {
    if (!pose.matrix().allFinite())
    {
      throw Error("A pose that a copy is let go at is not finite.");
    }
    world.add(pose);
  }
  double now = 0.0;
  FilledBin settled = rested(world, part,
    [&]
    {
      world.step();
      now += Step;
      report(progress, 0.05 + 0.95 * std::min(now / (TimeToRest + TimeToCalm), 1.0));
    });
  report(progress, 1.0);
  return settled;
}
}
