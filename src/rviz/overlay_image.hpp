// A picture in front of rviz's 3D view, in pixels of the window.
#pragma once

#include <OGRE/OgreMaterial.h>
#include <OGRE/OgreTexture.h>

#include <QImage>
#include <cstdint>
#include <string>

namespace Ogre {
class Overlay;
class PanelOverlayElement;
}  // namespace Ogre

namespace otter_nav::rviz_plugins {

class OverlayImage {
 public:
  // `name` has to be unlike any other's.
  explicit OverlayImage(const std::string& name);
  ~OverlayImage();
  OverlayImage(const OverlayImage&) = delete;
  OverlayImage& operator=(const OverlayImage&) = delete;

  // Format_ARGB32, its left upper corner at (left, top).
  void show(const QImage& image, int left, int top);
  void hide();

 private:
  void resize(const QSize& size);

  std::string name_;
  Ogre::Overlay* overlay_;
  Ogre::PanelOverlayElement* panel_;
  Ogre::MaterialPtr material_;
  Ogre::TexturePtr texture_;
};

// For things of Ogre's, which may not share a name.
[[nodiscard]] inline std::string uniqueName(const std::string& what, const void* owner) {
  return "otter_nav " + what + " " + std::to_string(reinterpret_cast<std::uintptr_t>(owner));
}

// Copies a part of an image, ARGB32, to the same place of a texture of its size.
void upload(const QImage& image, const QRect& part, Ogre::Texture& texture);
// An empty texture for that.
[[nodiscard]] Ogre::TexturePtr makeTexture(const std::string& name, const QSize& size);

}  // namespace otter_nav::rviz_plugins
