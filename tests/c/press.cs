// The force that press.c and press.py feel, from C#; and what is said of nonsense.
using System;
using System.Globalization;
using Hapbeam;

static class Press {
  static int Main() {
    var bar = Beam.Rectangle(2.54, 0.0254, 0.0254, 206.84e9, End.Pinned, End.Pinned);
    var felt = new Contact();
    var line = new double[2 * 101];
    using (var touch = new Touch(bar, Kinematics.VonKarman, 16, 0.01)) {
      for (int i = 0; i < 1000; ++i) felt = touch.Tick(1.27, 0.03 - 1.73e-5 * i);
      if (touch.Shape(line) != 101 || Math.Abs(line[2 * 50 + 1] - felt.D) > 1e-12) return 1;
      touch.Reset();
      if (touch.Shape(line) != 101 || line[2 * 50 + 1] != 0) return 2;
    }
    if (felt.Pressing != 1 || felt.Status != 0) return 3;
    Console.WriteLine(felt.ForceW.ToString("G17", CultureInfo.InvariantCulture));
    try {
      new Touch(bar, Kinematics.VonKarman, 16, 0.01, new Friction { Sticking = 0.3, Sliding = 0.3 });
      return 4;
    } catch (ArgumentException why) {
      return why.Message.StartsWith("friction = 0.3", StringComparison.Ordinal) ? 0 : 5;
    }
  }
}
