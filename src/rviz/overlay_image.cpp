#include "overlay_image.hpp"

#include <OGRE/OgreHardwarePixelBuffer.h>
#include <OGRE/OgreMaterialManager.h>
#include <OGRE/OgreTechnique.h>
#include <OGRE/OgreTextureManager.h>
#include <OGRE/Overlay/OgreOverlay.h>
#include <OGRE/Overlay/OgreOverlayManager.h>
#include <OGRE/Overlay/OgrePanelOverlayElement.h>

namespace otter_nav::rviz_plugins {

void upload(const QImage& image, const QRect& part, Ogre::Texture& texture) {
  const QImage piece = image.copy(part);
  // QImage pads no row of 32-bit pixels.
  const Ogre::PixelBox pixels(static_cast<std::uint32_t>(piece.width()),
                              static_cast<std::uint32_t>(piece.height()), 1, Ogre::PF_A8R8G8B8,
                              const_cast<uchar*>(piece.constBits()));  // NOLINT: it only reads
  texture.getBuffer()->blitFromMemory(
      pixels,
      Ogre::Box(static_cast<std::uint32_t>(part.left()), static_cast<std::uint32_t>(part.top()),
                static_cast<std::uint32_t>(part.right() + 1),
                static_cast<std::uint32_t>(part.bottom() + 1)));
}

Ogre::TexturePtr makeTexture(const std::string& name, const QSize& size) {
  return Ogre::TextureManager::getSingleton().createManual(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D,
      static_cast<Ogre::uint>(size.width()), static_cast<Ogre::uint>(size.height()), 0,
      Ogre::PF_A8R8G8B8, Ogre::TU_DYNAMIC_WRITE_ONLY);
}

OverlayImage::OverlayImage(const std::string& name) : name_(name) {
  Ogre::OverlayManager& manager = Ogre::OverlayManager::getSingleton();
  overlay_ = manager.create(name_);
  panel_ = dynamic_cast<Ogre::PanelOverlayElement*>(
      manager.createOverlayElement("Panel", name_ + " panel"));
  panel_->setMetricsMode(Ogre::GMM_PIXELS);
  material_ = Ogre::MaterialManager::getSingleton().create(
      name_ + " material", Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  panel_->setMaterial(material_);
  overlay_->add2D(panel_);
}

OverlayImage::~OverlayImage() {
  Ogre::OverlayManager& manager = Ogre::OverlayManager::getSingleton();
  manager.destroy(overlay_);
  manager.destroyOverlayElement(panel_);
  Ogre::MaterialManager::getSingleton().remove(material_);
  if (texture_) {
    Ogre::TextureManager::getSingleton().remove(texture_);
  }
}

void OverlayImage::resize(const QSize& size) {
  if (texture_ && static_cast<int>(texture_->getWidth()) == size.width() &&
      static_cast<int>(texture_->getHeight()) == size.height()) {
    return;
  }
  if (texture_) {
    Ogre::TextureManager::getSingleton().remove(texture_);
  }
  texture_ = makeTexture(name_ + " texture", size);
  Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
  pass->removeAllTextureUnitStates();
  pass->setLightingEnabled(false);
  pass->setDepthCheckEnabled(false);
  pass->setDepthWriteEnabled(false);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  Ogre::TextureUnitState* unit = pass->createTextureUnitState();
  unit->setTexture(texture_);
  unit->setTextureFiltering(Ogre::TFO_NONE);
}

void OverlayImage::show(const QImage& image, int left, int top) {
  resize(image.size());
  upload(image, image.rect(), *texture_);
  panel_->setPosition(static_cast<Ogre::Real>(left), static_cast<Ogre::Real>(top));
  panel_->setDimensions(static_cast<Ogre::Real>(image.width()),
                        static_cast<Ogre::Real>(image.height()));
  overlay_->show();
}

void OverlayImage::hide() {
  overlay_->hide();
}

}  // namespace otter_nav::rviz_plugins
