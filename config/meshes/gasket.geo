// A gasket: a plate with two bolt holes, lying on a foundation. Made with Gmsh 4.15.2 by
//     gmsh -2 -format msh22 -o gasket.msh gasket.geo
// The file depends on nothing else; refined levels keep the polygons that stand for the holes.
SetFactory("Built-in");
Mesh.Algorithm = 6;

width = 2;
height = 1;
radius = 0.2;
coarse = 0.2;
fine = 0.08;

Point(1) = {0, 0, 0, coarse / 2};
Point(2) = {width, 0, 0, coarse / 2};
Point(3) = {width, height, 0, coarse};
Point(4) = {0, height, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

For k In {0 : 1}
  x = width * (1 + 2 * k) / 4;
  c = 10 + 10 * k;
  Point(c) = {x, 0.6, 0, fine};
  Point(c + 1) = {x + radius, 0.6, 0, fine};
  Point(c + 2) = {x, 0.6 + radius, 0, fine};
  Point(c + 3) = {x - radius, 0.6, 0, fine};
  Point(c + 4) = {x, 0.6 - radius, 0, fine};
  Circle(c + 1) = {c + 1, c, c + 2};
  Circle(c + 2) = {c + 2, c, c + 3};
  Circle(c + 3) = {c + 3, c, c + 4};
  Circle(c + 4) = {c + 4, c, c + 1};
  Curve Loop(c) = {c + 1, c + 2, c + 3, c + 4};
EndFor

Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1, 10, 20};

Physical Curve("foundation", 1) = {1};
Physical Curve("free", 2) = {2, 3, 4};
Physical Curve("clamped", 3) = {11 : 14, 21 : 24};
Physical Surface("plate", 4) = {1};
