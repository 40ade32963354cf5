// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/PartContacts.h"

#include "base/Bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace meam
{
namespace
{
constexpr int Directions = 6;     // of contact: Bullet keeps up to four contacts of each
constexpr double Friction = 0.4;  // plastic on plastic
constexpr double Bounce = 0.1;    // restitution
constexpr double Slack = 0.003;   // diameters: contacts are known a little before they are there
constexpr double Favour = 0.0005; // diameters: so much deeper has a contact to be to end one that was there before
constexpr double Bearing = 0.003; // diameters: contacts so much less deep than the deepest bear weight, too
constexpr int PartType = CUSTOM_CONCAVE_SHAPE_TYPE;

Eigen::Isometry3f toEigen(const btTransform& transform)
{
  Eigen::Isometry3f result;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      result(row, column) = static_cast<float>(transform.getBasis()[row][column]);
    }
    result(row, 3) = static_cast<float>(transform.getOrigin()[row]);
  }
  return result;
}

btVector3 toBullet(const Eigen::Vector3f& vector) { return btVector3(vector.x(), vector.y(), vector.z()); }

double speedOf(const btCollisionObject& body, double radius)
{
  return body.getInterpolationLinearVelocity().length() + radius * body.getInterpolationAngularVelocity().length();
}

/// A point of one body near the surface of another one, in the world.
struct Candidate
{
  int index; ///< of the point
  btVector3 point;
  btVector3 normal; ///< of the surface
  double distance;  ///< from the surface
  bool lasting;     ///< it was a contact at the step before
};

/// Up to four that hold a body: the deepest one, and others that span the widest. Contacts that last are
/// preferred: a body would tremble on ever other ones.
void thin(std::vector<Candidate>& candidates)
{
  std::size_t chosen = 0;
  const auto choose = [&](const auto& worth)
  {
    std::size_t best = chosen;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = chosen; i < candidates.size(); ++i)
    {
      const double value = worth(candidates[i]);
      best = value > most ? i : best;
      most = std::max(most, value);
    }
    std::swap(candidates[chosen++], candidates[best]);
  };
  if (candidates.size() <= MANIFOLD_CACHE_SIZE)
  {
    return;
  }
  const auto favour = [](const Candidate& c) { return c.lasting ? 1.2 : 1.0; };
  choose([&](const Candidate& c) { return -c.distance + (c.lasting ? Favour : 0.0); });
  // Of the others those that would bear weight.
  const double reach = candidates[0].distance + Bearing;
  candidates.erase(
    std::remove_if(candidates.begin() + 1, candidates.end(), [&](const Candidate& c) { return c.distance > reach; }),
    candidates.end());
  if (candidates.size() <= MANIFOLD_CACHE_SIZE)
  {
    return;
  }
  const btVector3 a = candidates[0].point;
  choose([&](const Candidate& c) { return favour(c) * (c.point - a).length(); });
  const btVector3 side = candidates[0].normal.cross(candidates[1].point - a);
  choose([&](const Candidate& c) { return favour(c) * std::abs(side.dot(c.point - a)); });
  const double sign = side.dot(candidates[2].point - a) > 0.0 ? -1.0 : 1.0;
  choose([&](const Candidate& c) { return favour(c) * sign * side.dot(c.point - a); });
  candidates.resize(chosen);
}

/// The contacts between two bodies, found anew at every step; one at the same point as before starts with its
/// forces.
class Contacts
{
public:
  Contacts(btDispatcher& dispatcher, const btCollisionObject& first, const btCollisionObject& second)
    : Dispatcher(dispatcher)
    , First(first)
    , Second(second)
  {
  }
  ~Contacts()
  {
    for (const Group& group : this->Groups)
    {
      if (group.manifold)
      {
        this->Dispatcher.releaseManifold(group.manifold);
      }
    }
  }
  Contacts(const Contacts&) = delete;
  void operator=(const Contacts&) = delete;

  /// Point `index` of one body at `point` (world) is at `distance` from the other one, whose surface faces
  /// along `normal`.
  void add(bool pointOfFirst, int index, const btVector3& point, const btVector3& normal, double distance)
  {
    const int axis = normal.absolute().maxAxis();
    Group& group = this->Groups[(pointOfFirst ? 0 : Directions) + 2 * axis + (normal[axis] < 0.0)];
    group.candidates.push_back({ index, point, normal, distance, group.before(index) != nullptr });
  }

  /// Hands those that were added since the last time on to Bullet.
  void handOver()
  {
    for (std::size_t i = 0; i < this->Groups.size(); ++i)
    {
      Group& group = this->Groups[i];
      if (!group.manifold && group.candidates.empty())
      {
        continue;
      }
      if (!group.manifold)
      {
        group.manifold = this->Dispatcher.getNewManifold(&this->First, &this->Second);
      }
      thin(group.candidates);
      std::vector<btManifoldPoint> points;
      for (const Candidate& candidate : group.candidates)
      {
        points.push_back(this->contact(i < Directions, candidate));
        if (const btManifoldPoint* before = group.before(candidate.index))
        {
          points.back().m_appliedImpulse = before->m_appliedImpulse;
          points.back().m_appliedImpulseLateral1 = before->m_appliedImpulseLateral1;
          points.back().m_appliedImpulseLateral2 = before->m_appliedImpulseLateral2;
        }
      }
      group.manifold->clearManifold();
      for (const btManifoldPoint& point : points)
      {
        group.manifold->addManifoldPoint(point);
      }
      group.candidates.clear();
    }
  }

  void list(btManifoldArray& manifolds) const
  {
    for (const Group& group : this->Groups)
    {
      if (group.manifold)
      {
        manifolds.push_back(group.manifold);
      }
    }
  }

private:
  /// Contacts with normals of about the same direction.
  struct Group
  {
    btPersistentManifold* manifold = nullptr;
    std::vector<Candidate> candidates;

    /// The contact at a point that Bullet still has from the step before, or null.
    const btManifoldPoint* before(int index) const
    {
      for (int k = 0; this->manifold && k < this->manifold->getNumContacts(); ++k)
      {
        if (this->manifold->getContactPoint(k).m_index0 == index)
        {
          return &this->manifold->getContactPoint(k);
        }
      }
      return nullptr;
    }
  };

  btManifoldPoint contact(bool pointOfFirst, const Candidate& candidate) const
  {
    const btVector3 onOther = candidate.point - candidate.distance * candidate.normal;
    const btVector3& onFirst = pointOfFirst ? candidate.point : onOther;
    const btVector3& onSecond = pointOfFirst ? onOther : candidate.point;
    btManifoldPoint result(this->First.getWorldTransform().invXform(onFirst),
      this->Second.getWorldTransform().invXform(onSecond), pointOfFirst ? candidate.normal : -candidate.normal,
      candidate.distance);
    result.m_positionWorldOnA = onFirst;
    result.m_positionWorldOnB = onSecond;
    result.m_combinedFriction = Friction;
    result.m_combinedRestitution = Bounce;
    result.m_index0 = candidate.index;
    return result;
  }

  btDispatcher& Dispatcher;
  const btCollisionObject& First;
  const btCollisionObject& Second;
  std::array<Group, 2 * Directions> Groups;
};

/// What Bullet asks of every kind of contact.
class ContactAlgorithm : public btCollisionAlgorithm
{
public:
  ContactAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
    const btCollisionObjectWrapper* second)
    : btCollisionAlgorithm(info)
    , Found(
        std::make_unique<Contacts>(*info.m_dispatcher1, *first->getCollisionObject(), *second->getCollisionObject()))
  {
  }
  btScalar calculateTimeOfImpact(
    btCollisionObject*, btCollisionObject*, const btDispatcherInfo&, btManifoldResult*) override
  {
    return 1.0;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override { this->Found->list(manifolds); }

protected:
  std::unique_ptr<Contacts> Found; // elsewhere: Bullet's memory for algorithms is small
};

const PartShape& partOf(const btCollisionObjectWrapper* body)
{
  return static_cast<const PartShape&>(*body->getCollisionShape());
}

class PartPartAlgorithm : public ContactAlgorithm
{
public:
  using ContactAlgorithm::ContactAlgorithm;
  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
    const btDispatcherInfo& info, btManifoldResult*) override
  {
    const double reach = info.m_timeStep * (speedOf(*first->getCollisionObject(), partOf(first).radius()) +
                                             speedOf(*second->getCollisionObject(), partOf(second).radius())) +
                         Slack;
    this->touch(true, first, second, static_cast<float>(reach));
    this->touch(false, second, first, static_cast<float>(reach));
    this->Found->handOver();
  }

private:
  void touch(bool ofFirst, const btCollisionObjectWrapper* body, const btCollisionObjectWrapper* other, float reach)
  {
    const btTransform& T_world_other = other->getWorldTransform();
    const Eigen::Isometry3f T_other_body = toEigen(T_world_other.inverseTimes(body->getWorldTransform()));
    const SphereTree& points = partOf(body).points();
    const SignedDistanceGrid& surface = partOf(other).distances();
    const float skin = partOf(other).skin();
    points.forEachNear([&](const Eigen::Vector3f& centre, float radius)
      { return surface.bound(T_other_body * centre) < radius + skin + reach; },
      [&](int index)
      {
        const Eigen::Vector3f point = T_other_body * points.points()[index];
        Eigen::Vector3f normal;
        const float distance = surface.at(point, normal) - skin;
        if (distance < reach && !normal.isZero())
        {
          this->Found->add(
            ofFirst, index, T_world_other * toBullet(point), T_world_other.getBasis() * toBullet(normal), distance);
        }
      });
  }
};

class PartPlaneAlgorithm : public ContactAlgorithm
{
public:
  using ContactAlgorithm::ContactAlgorithm;
  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
    const btDispatcherInfo& info, btManifoldResult*) override
  {
    const bool partFirst = first->getCollisionShape()->getShapeType() == PartType;
    const btCollisionObjectWrapper* body = partFirst ? first : second;
    const btCollisionObjectWrapper* wall = partFirst ? second : first;
    const auto& plane = static_cast<const btStaticPlaneShape&>(*wall->getCollisionShape());
    const btVector3 normal = wall->getWorldTransform().getBasis() * plane.getPlaneNormal();
    const btVector3 origin = wall->getWorldTransform() * (plane.getPlaneConstant() * plane.getPlaneNormal());
    const btTransform& T_world_body = body->getWorldTransform();
    const SphereTree& points = partOf(body).points();
    const double reach = info.m_timeStep * speedOf(*body->getCollisionObject(), partOf(body).radius()) + Slack;
    const auto distanceOf = [&](const Eigen::Vector3f& point)
    { return normal.dot(T_world_body * toBullet(point) - origin); };
    points.forEachNear([&](const Eigen::Vector3f& centre, float radius) { return distanceOf(centre) < radius + reach; },
      [&](int index)
      {
        const Eigen::Vector3f& point = points.points()[index];
        const double distance = distanceOf(point);
        if (distance < reach)
        {
          this->Found->add(partFirst, index, T_world_body * toBullet(point), normal, distance);
        }
      });
    this->Found->handOver();
  }
};

template <typename Algorithm>
struct Creation : btCollisionAlgorithmCreateFunc
{
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
    const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second) override
  {
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm));
    return new (memory) Algorithm(info, first, second);
  }
};
}

PartShape::PartShape(Points surfacePoints, SignedDistanceGrid distances, double skin)
  : SurfacePoints(std::move(surfacePoints))
  , Distances(std::move(distances))
  , Skin(static_cast<float>(skin))
  , Radius(0.0f)
  , Box(bounds(this->SurfacePoints.points()))
{
  this->m_shapeType = PartType;
  for (const Eigen::Vector3f& point : this->SurfacePoints.points())
  {
    this->Radius = std::max(this->Radius, point.norm());
  }
}

void PartShape::getAabb(const btTransform& T_world_body, btVector3& low, btVector3& high) const
{
  const btVector3 middle = T_world_body * toBullet(this->Box.center());
  const btVector3 half = toBullet(0.5f * this->Box.sizes());
  const btMatrix3x3 size = T_world_body.getBasis().absolute();
  const btVector3 reach = btVector3(size[0].dot(half), size[1].dot(half), size[2].dot(half)) +
                          (this->Skin + Slack) * btVector3(1.0, 1.0, 1.0);
  low = middle - reach;
  high = middle + reach;
}

void registerPartContacts(btCollisionDispatcher& dispatcher)
{
  static Creation<PartPartAlgorithm> partPart;
  static Creation<PartPlaneAlgorithm> partPlane;
  dispatcher.registerCollisionCreateFunc(PartType, PartType, &partPart);
  dispatcher.registerCollisionCreateFunc(PartType, STATIC_PLANE_PROXYTYPE, &partPlane);
  dispatcher.registerCollisionCreateFunc(STATIC_PLANE_PROXYTYPE, PartType, &partPlane);
}
}
