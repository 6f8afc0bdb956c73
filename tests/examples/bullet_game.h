/* SPDX-License-Identifier: MIT
 * bullet_game.h: what the user of bullet_playground.cpp has before Tahr comes: a level of one mesh and some boxes in a
 * Bullet world, and how deep a shape is in it. */
#ifndef BULLET_GAME_H
#define BULLET_GAME_H

#include <btBulletCollisionCommon.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/* The deepest contact of a shape with the world. */
struct deepest : btCollisionWorld::ContactResultCallback {
    const btCollisionObject *self = nullptr;
    btVector3 normal{0, 0, 0}; /* from the world to the shape */
    btScalar distance = 0;     /* < 0: there is one */
    int body = -1;

    btScalar addSingleResult(btManifoldPoint &point, const btCollisionObjectWrapper *a, int, int,
                             const btCollisionObjectWrapper *b, int, int) override
    {
        bool first = a->getCollisionObject() == self;
        if (point.getDistance() < distance) {
            distance = point.getDistance();
            normal = first ? point.m_normalWorldOnB : -point.m_normalWorldOnB;
            body = (first ? b : a)->getCollisionObject()->getUserIndex();
        }
        return 0;
    }
};

class bullet_game
{
  public:
    /* Flat ground, eight steps of 0.3 m up and down again, a ramp of 35 degrees, a wall of 2 cm. */
    void build()
    {
        for (int x = -30; x < 30; x += 2) {
            for (int y = -20; y < 34; y += 2) {
                profile({{x, 0}, {x + 2, 0}}, y, y + 2);
            }
        }
        line stairs = {{-28, 0}};
        for (int i = 1; i <= 8; i++) {
            stairs.insert(stairs.end(), {{-28 + 0.3 * (i - 1), 0.3 * i}, {-28 + 0.3 * i, 0.3 * i}});
        }
        for (int i = 0; i < 8; i++) {
            stairs.insert(stairs.end(), {{-22.3 + 0.3 * i, 2.4 - 0.3 * i}, {-22.3 + 0.3 * i, 2.1 - 0.3 * i}});
        }
        profile(stairs, 13, 16.5);
        profile({{-11.856, 0}, {-9, 2}, {-7, 2}, {-4.144, 0}}, 9.8, 12.3);
        boxes.push_back(std::make_unique<btBoxShape>(btVector3(2, btScalar(0.01), btScalar(1.25))));
        boxes.back()->setMargin(btScalar(0.001)); /* Bullet rounds its corners by the margin */
        add(*boxes.back(), btVector3(13, -10, btScalar(1.25)));
        add_mesh();
    }

    /* Y up, as `tahr level` writes it. */
    bool read(const char *path)
    {
        std::ifstream file(path);
        std::vector<btVector3> vertices;
        for (std::string text; std::getline(file, text);) {
            std::istringstream in(text);
            std::string kind;
            in >> kind;
            if (kind == "v") {
                double x = 0, y = 0, z = 0;
                in >> x >> y >> z;
                vertices.emplace_back(btScalar(x), btScalar(-z), btScalar(y));
            } else if (kind == "f") {
                size_t i[3] = {0, 0, 0};
                in >> i[0] >> i[1] >> i[2];
                for (size_t k : i) {
                    if (k < 1 || k > vertices.size()) return false;
                }
                mesh.addTriangle(vertices[i[0] - 1], vertices[i[1] - 1], vertices[i[2] - 1]);
            }
        }
        if (mesh.getNumTriangles() == 0) return false;
        add_mesh();
        return true;
    }

    deepest overlap(btCollisionShape &of, const btTransform &at)
    {
        btCollisionObject self;
        deepest found;
        self.setCollisionShape(&of);
        self.setWorldTransform(at);
        found.self = &self;
        world.contactTest(&self, found);
        return found;
    }

    std::vector<std::unique_ptr<btCollisionObject>> objects; /* a body's number is its place here */
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};

  private:
    using line = std::vector<std::pair<double, double>>;

    /* A line of (x, z) corners, drawn out from y0 to y1. */
    void profile(const line &l, double y0, double y1)
    {
        for (size_t i = 0; i + 1 < l.size(); i++) {
            auto at = [&](size_t k, double y) {
                return btVector3(btScalar(l[k].first), btScalar(y), btScalar(l[k].second));
            };
            mesh.addTriangle(at(i, y0), at(i + 1, y0), at(i + 1, y1));
            mesh.addTriangle(at(i, y0), at(i + 1, y1), at(i, y1));
        }
    }

    void add_mesh()
    {
        shape = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
        shape->setMargin(0); /* else every triangle is 4 cm thick */
        add(*shape, btVector3(0, 0, 0));
    }

    void add(btCollisionShape &of, btVector3 at)
    {
        objects.push_back(std::make_unique<btCollisionObject>());
        btCollisionObject &object = *objects.back();
        object.setCollisionShape(&of);
        object.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
        object.setUserIndex(int(objects.size()) - 1);
        world.addCollisionObject(&object);
    }

    btTriangleMesh mesh;
    std::unique_ptr<btBvhTriangleMeshShape> shape;
    std::vector<std::unique_ptr<btBoxShape>> boxes;
};

#endif
