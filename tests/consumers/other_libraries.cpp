// The program is linked with other libraries that have the functions of MuJoCo and assimp.
#include <fstream>
#include <iostream>

#include <kinegraph/kinegraph.h>

using namespace kinegraph;

int main() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("box").setShape(ShapeType::ssBox, {.06, .06, .06, .005}).setPosition({0., .3, .8}).setMass(1.);
  Simulation simulation(C);
  for (int i = 0; i < 100; ++i) simulation.step();
  const double height = C.getFrame("box").getPosition().z();  // on the table at .65 m

  std::ofstream("tetrahedron.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::ofstream("tetrahedron.off") << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  std::size_t vertices = 0;
  for (const std::string file : {"tetrahedron.obj", "tetrahedron.off"}) {
    Config mesh;
    mesh.addText("m: { mesh: <" + file + "> }", "text", ".");
    vertices += mesh.getFrame("m").data().shape->geometry->mesh->vertices.size();
  }
  std::cout << height << ' ' << vertices << std::endl;
  return height > .6 && height < .7 && vertices == 8 ? 0 : 1;
}
