// Columns of arguments -> columns of what the lane maths makes of them.
#include "tests/kernels/lane_probe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/kernels/lane_probe.cc"
#include <hwy/foreach_target.h>

#include "kernels/hit_surface-inl.h"
#include "kernels/lights-inl.h"
#include "kernels/tangent-inl.h"
#include "tests/kernels/probe_row-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

void ProbeNextFloat(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const Mask up = ToFloatMask(hn::Ne(row.Word(1), hn::Zero(DU())));
    row.Put(0, NextFloat(row.Float(0), up));
  }
}

void ProbeFrame(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const Frame frame = MakeFrame(row.Vector(0));
    const Vec3 local = ToLocal(frame, row.Vector(3));
    row.Put(0, frame.x);
    row.Put(3, frame.y);
    row.Put(6, local);
    row.Put(9, ToWorld(frame, local));
  }
}

void ProbeTangent(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const UvAxes axes = MakeAxes(*args.scene, row.Vector(0), row.Index(3));
    const Tangent tangent = HitTangent(*args.scene, row.Vector(4), axes, row.Index(7), row.Index(3),
                                       row.Float(8), row.Float(9));
    const Frame frame = MakeFrameAlong(row.Vector(4), tangent.along);
    row.Put(0, frame.x);
    row.Put(3, frame.y);
    row.Put(6, frame.z);
    row.Put(9, tangent.side);
  }
}

HWY_INLINE void PutSurface(const ProbeRow& row, const Surface& s) {
  row.Put(0, s.p);
  row.Put(3, s.error);
  row.Put(6, s.n);
  row.Put(9, s.ns);
  row.Put(12, s.area_scale);
}

void ProbeSurface(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    PutSurface(row, MakeSurface(*args.scene, row.Vector(0), row.Vector(3), row.Float(6),
                                row.Index(7), row.Float(8), row.Float(9)));
  }
}

void ProbeHitSurface(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    PutSurface(row, HitSurface(*args.scene, row.Vector(0), row.Vector(3), row.Float(6),
                               row.Index(10), row.Index(7), row.Float(8), row.Float(9)));
  }
}

void ProbeOffsetOrigin(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    row.Put(0, OffsetOrigin(row.Vector(0), row.Vector(3), row.Vector(6), row.Vector(9)));
  }
}

void ProbeSampleLight(const ProbeArgs& args) {
  const U32 one = SetU(1), two = SetU(2);
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const LightSample s = SampleLight(*args.scene, row.Vector(0), SetU(kNoNormalCode), row.Float(3),
                                      row.Float(4), row.Float(5));
    row.Put(0, s.wi);
    row.Put(3, s.end);
    row.Put(6, Vec3{s.radiance.r, s.radiance.g, s.radiance.b});
    row.Put(9, s.pdf);
    row.Put(10, hn::Or(hn::IfThenElseZero(ToUintMask(s.at_infinity), one),
                       hn::IfThenElseZero(ToUintMask(s.is_delta), two)));
    row.Put(
        11,
        ChooseLight(args.scene->lights, row.Vector(0), SetU(kNoNormalCode), row.Float(3)).light);
  }
}

void ProbeLightPdf(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    row.Put(0, LightPdf(args.scene->lights, row.Index(0), row.Vector(1), SetU(kNoNormalCode),
                        row.Float(4), row.Float(5), row.Float(6)));
  }
}

void ProbeNormalCode(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const U32 code = EncodeNormal(row.Vector(0));
    row.Put(0, code);
    row.Put(1, DecodeNormal(code));
  }
}

void ProbePowerHeuristic(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    row.Put(0, PowerHeuristic(row.Float(0), row.Float(1)));
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#define SWELL_DISPATCH_PROBE(Name) \
  HWY_EXPORT(Name);                \
  void Name(const ProbeArgs& args) { HWY_DYNAMIC_DISPATCH(Name)(args); }
namespace swell::SWELL_WIDTH {
SWELL_DISPATCH_PROBE(ProbeNextFloat)
SWELL_DISPATCH_PROBE(ProbeFrame)
SWELL_DISPATCH_PROBE(ProbeTangent)
SWELL_DISPATCH_PROBE(ProbeSurface)
SWELL_DISPATCH_PROBE(ProbeHitSurface)
SWELL_DISPATCH_PROBE(ProbeOffsetOrigin)
SWELL_DISPATCH_PROBE(ProbeSampleLight)
SWELL_DISPATCH_PROBE(ProbeLightPdf)
SWELL_DISPATCH_PROBE(ProbeNormalCode)
SWELL_DISPATCH_PROBE(ProbePowerHeuristic)
}  // namespace swell::SWELL_WIDTH
#endif
