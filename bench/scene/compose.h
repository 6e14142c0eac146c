// The picture from its parts: direct light, diffuse indirect, specular indirect, emission, each counted once.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "bench/scene/gbuffer.h"

namespace luxel::scene {

/// Light at the pixels of a G-buffer, by whatever method. Irradiances do not hold the receiver's albedo.
struct Lighting {
  std::vector<glm::dvec3> sun;       // irradiance from the sun
  std::vector<glm::dvec3> direct;    // irradiance from emitting surfaces and the sky, seen directly
  std::vector<glm::dvec3> indirect;  // irradiance from surfaces that reflect light
  std::vector<glm::dvec3> glossy;    // mean radiance in the specular lobe: all that it sees, emitters and sky included
  std::vector<double> visibility;    // ambient occlusion's, 0..1
};

/// What a picture is the sum of, as radiance towards the camera; and ambient occlusion beside it.
struct Parts {
  std::vector<glm::dvec3> emission;           // of the surface itself, or the sky behind
  std::vector<glm::dvec3> direct;             // sun, emitters and sky reflected diffusely; the sun's highlight
  std::vector<glm::dvec3> diffuse_indirect;
  std::vector<glm::dvec3> specular_indirect;  // what a glossy surface mirrors: surfaces, emitters and sky
  std::vector<double> ambient_occlusion;      // the visibility: in no sum, as indirect light is occluded already
};

/// With D the share that a surface mirrors (directional_albedo), per channel, a the albedo, E irradiance:
///   emission          = Le
///   direct            = (1 - D) a/pi (E_sun + E_direct) + f E_sun, f the GGX reflection of the sun
///   diffuse_indirect  = (1 - D) a/pi E_indirect
///   specular_indirect = D glossy
/// The sun is a point and no lobe's ray meets it: its mirror image is f alone. Emitters and sky are met by lobes: theirs is
/// in `glossy` alone, and their irradiance is reflected diffusely alone. A surface of albedo 1 in a uniform environment
/// sends back that environment: (1 - D) + D = 1. Surfaces without specular reflectance have D = 0 and f = 0.
Parts compose(const GBuffer& gbuffer, const Lighting& lighting, glm::dvec3 eye, const Sun& sun);

/// The sum of the four parts.
std::vector<glm::dvec3> picture(const Parts& parts);

/// D: the share of a uniform environment that a GGX surface (alpha = roughness^2, height-correlated Smith masking) with
/// Fresnel's reflectance after Schlick mirrors: specular A + B (Karis 2013, Real Shading in Unreal Engine 4, the second
/// sum of "Environment BRDF"). From a table of 32 x 32, integrated in double; `cosine` of the view direction.
glm::dvec3 directional_albedo(glm::dvec3 specular, double roughness, double cosine);

/// f: the same surface's reflection, per steradian, for unit vectors on the normal's side (Walter et al. 2007, equation 20).
glm::dvec3 ggx_reflection(glm::dvec3 specular, double roughness, glm::dvec3 normal, glm::dvec3 view, glm::dvec3 light);

/// Exposure in stops, clamp to 0..1, sRGB curve (IEC 61966-2-1). For pictures to look at, never for numbers.
glm::dvec3 display(glm::dvec3 radiance, double exposure);

}  // namespace luxel::scene
