// SPDX-License-Identifier: MIT
// A beam under a round avatar, for C# and Unity on 64 bits.  Put this file and the library, libhapbeam.so, into Assets/Plugins.
//
//   var touch = new Hapbeam.Touch(Hapbeam.Beam.Rectangle(0.3, 0.025, 0.001, 210e9), Hapbeam.Kinematics.Corotational, 8, 0.005);
//   Hapbeam.Contact felt = touch.Tick(x, w);               // each millisecond, in a thread of your own: not in Update()
//   touch.Shape(points);                                   // of the last tick, x and w in turn: in the same thread
//   touch.Dispose();                                       // in OnDestroy(), after that thread has ended
//
// SI throughout: m, N.  x runs along the beam from its left end, w across it, up.  hapbeam.h says the rest.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Hapbeam {

public enum End { Free, Clamped, Pinned, Roller, Guided }
public enum Kinematics { Linear, VonKarman, Corotational }

[StructLayout(LayoutKind.Sequential)]
public struct Beam {
  public double Length, AxialStiffness, BendingStiffness, Thickness, TransverseLoad, AxialLoad;
  public End Left, Right;

  public static Beam Rectangle(double length, double width, double height, double young, End left = End.Clamped, End right = End.Free) =>
    hapbeam_rectangle(length, width, height, young, left, right);
  [DllImport("hapbeam")] static extern Beam hapbeam_rectangle(double length, double width, double height, double young, End left, End right);
}

[StructLayout(LayoutKind.Sequential)]
public struct Friction { public double Sticking, Sliding; }

[StructLayout(LayoutKind.Sequential)]
public struct Contact {
  public double ForceX, ForceW, FrictionX, FrictionW, S, D, Dissipated;  // forces on the hand
  public int Pressing, Sliding, Status;                                  // Status: negative where the model has no answer
}

public sealed class Touch : IDisposable {
  IntPtr touch;

  public Touch(Beam beam, Kinematics kinematics, int elements, double avatarRadius, Friction friction = default(Friction)) {
    var why = new StringBuilder(512);
    touch = hapbeam_touch_create(ref beam, kinematics, elements, avatarRadius, ref friction, why);
    if (touch == IntPtr.Zero) throw new ArgumentException(why.ToString());
  }
  public Contact Tick(double x, double w) => hapbeam_touch_tick(touch, x, w);
  public void Reset() => hapbeam_touch_reset(touch);
  public int Shape(double[] points) => hapbeam_touch_shape(touch, points, points.Length / 2);
  public void Dispose() { hapbeam_touch_destroy(touch); touch = IntPtr.Zero; }

  [DllImport("hapbeam")] static extern IntPtr hapbeam_touch_create(ref Beam beam, Kinematics kinematics, int elements, double radius, ref Friction friction, StringBuilder message);
  [DllImport("hapbeam")] static extern void hapbeam_touch_destroy(IntPtr touch);
  [DllImport("hapbeam")] static extern Contact hapbeam_touch_tick(IntPtr touch, double x, double w);
  [DllImport("hapbeam")] static extern void hapbeam_touch_reset(IntPtr touch);
  [DllImport("hapbeam")] static extern int hapbeam_touch_shape(IntPtr touch, [Out] double[] points, int count);
}

}
