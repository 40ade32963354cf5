// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/PartContacts.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"

#include <array>
#include <cmath>

namespace
{
constexpr double Skin = 0.01;

/// A cube of side 1 about the origin: its corners, and the middles of its faces, are what may touch.
meam::PartShape cube()
{
  auto points = meam::ofIndices<Eigen::Vector3f>(
    8, [&](int i) { return Eigen::Vector3f((i & 1) - 0.5f, ((i >> 1) & 1) - 0.5f, (i >> 2) - 0.5f); });
  for (int axis = 0; axis < 3; ++axis)
  {
    points.push_back(0.5f * Eigen::Vector3f::Unit(axis));
    points.push_back(-0.5f * Eigen::Vector3f::Unit(axis));
  }
  const Eigen::Vector3f half = Eigen::Vector3f::Constant(0.5f);
  return { points, meam::SignedDistanceGrid(parts::box(-half, half), true, 0.05), Skin };
}

/// A contact as Bullet has it: how far apart the bodies are, and the second one's normal.
struct Contact
{
  double distance;
  btVector3 normal;
};

/// Two bodies that do not move, and where they touch.
std::vector<Contact> contactsOf(btCollisionShape& first, const btVector3& firstAt, btCollisionShape& second,
  const btVector3& secondAt, double angle = 0.0)
{
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  meam::registerPartContacts(dispatcher);
  btDbvtBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  std::array<btCollisionObject, 2> bodies;
  bodies[0].setCollisionShape(&first);
  bodies[0].setWorldTransform(btTransform(btQuaternion(btVector3(1, 0, 0), angle), firstAt));
  bodies[1].setCollisionShape(&second);
  bodies[1].setWorldTransform(btTransform(btQuaternion::getIdentity(), secondAt));
  for (btCollisionObject& body : bodies)
  {
    world.addCollisionObject(&body);
  }
  world.performDiscreteCollisionDetection();
  std::vector<Contact> contacts;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
  {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k)
    {
      const double sign = manifold.getBody0() == &bodies[0] ? 1.0 : -1.0;
      const btManifoldPoint& point = manifold.getContactPoint(k);
      contacts.push_back({ point.getDistance(), sign * point.m_normalWorldOnB });
    }
  }
  for (btCollisionObject& body : bodies)
  {
    world.removeCollisionObject(&body);
  }
  return contacts;
}

std::vector<Contact> onTheFloor(double height, double angle = 0.0)
{
  meam::PartShape part = cube();
  btStaticPlaneShape floor(btVector3(0, 0, 1), 0.0);
  return contactsOf(part, btVector3(0, 0, height), floor, btVector3(0, 0, 0), angle);
}
}

TEST(PartContacts, ACubeStandsOnItsFourCorners)
{
  const auto contacts = onTheFloor(0.499); // a thousandth in the floor
  ASSERT_EQ(contacts.size(), 4u);
  for (const Contact& contact : contacts)
  {
    EXPECT_NEAR(contact.distance, -0.001, 1e-6);
    EXPECT_NEAR(contact.normal.z(), 1.0, 1e-6);
  }
}

TEST(PartContacts, ATiltedCubeStandsOnOneSide)
{
  const double angle = 20.0 * M_PI / 180.0;
  const double lowest = 0.5 * (std::cos(angle) + std::sin(angle));
  EXPECT_EQ(onTheFloor(lowest - 0.001, angle).size(), 2u);
}

TEST(PartContacts, ACubeAboveTheFloorTouchesNothing) { EXPECT_TRUE(onTheFloor(0.51).empty()); }

TEST(PartContacts, PartsRestASkinApart)
{
  meam::PartShape lower = cube(), upper = cube();
  const auto resting = contactsOf(upper, btVector3(0.2, 0.1, 1.0 + Skin), lower, btVector3(0, 0, 0));
  ASSERT_FALSE(resting.empty());
  for (const Contact& contact : resting)
  {
    EXPECT_NEAR(contact.distance, 0.0, 2e-3);
    EXPECT_NEAR(contact.normal.z(), 1.0, 1e-3);
  }
  const auto pressed = contactsOf(upper, btVector3(0.2, 0.1, 1.0), lower, btVector3(0, 0, 0));
  ASSERT_FALSE(pressed.empty());
  EXPECT_NEAR(pressed[0].distance, -Skin, 2e-3);
  EXPECT_TRUE(contactsOf(upper, btVector3(0.2, 0.1, 1.1), lower, btVector3(0, 0, 0)).empty());
}

TEST(PartContacts, TheBoxAroundAPartHasItsSkin)
{
  btVector3 low, high;
  cube().getAabb(btTransform(btQuaternion::getIdentity(), btVector3(1, 2, 3)), low, high);
  EXPECT_LE(low.x(), 0.5 - Skin);
  EXPECT_GE(low.x(), 0.45);
  EXPECT_GE(high.z(), 3.5 + Skin);
  EXPECT_NEAR(cube().radius(), std::sqrt(0.75), 1e-6);
}
