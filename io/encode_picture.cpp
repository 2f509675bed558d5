#include "io/encode_picture.hpp"

#include <cpl_vsi.h>
#include <gdal_frmts.h>

#include <memory>

#include "io/gdal_support.hpp"

namespace terrawalk {

namespace {

struct VsiDeleter {
    void operator()(GByte* bytes) const { VSIFree(bytes); }
};

}  // namespace

Result<std::string> encodePng(const ReliefImage& image) {
    constexpr int kBands = 4;
    const GdalErrors errors;
    GDALRegister_MEM();
    GDALRegister_PNG();
    const auto failed = [&] {
        return systemError("the picture cannot be encoded: " + errors.text());
    };
    GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
    GDALDriver* png = GetGDALDriverManager()->GetDriverByName("PNG");
    if (memory == nullptr || png == nullptr) return failed();
    const int columns = static_cast<int>(image.columns);
    const int rows = static_cast<int>(image.rows);
    const GdalDataset source(memory->Create("", columns, rows, kBands, GDT_Byte, nullptr));
    if (!source) return failed();
    // GDAL takes what it reads from as writable.
    auto* pixels = const_cast<std::uint8_t*>(image.rgba.data());
    if (source->RasterIO(GF_Write, 0, 0, columns, rows, pixels, columns, rows, GDT_Byte, kBands, nullptr,
                         kBands, static_cast<GSpacing>(kBands) * columns, 1, nullptr) != CE_None) {
        return failed();
    }
    source->GetRasterBand(kBands)->SetColorInterpretation(GCI_AlphaBand);
    // The address makes the name unique among threads.
    const std::string name =
        "/vsimem/terrawalk-" + std::to_string(reinterpret_cast<std::uintptr_t>(&errors)) + ".png";
    {
        const GdalDataset written(
            png->CreateCopy(name.c_str(), source.get(), FALSE, nullptr, nullptr, nullptr));
        if (!written) return failed();
    }
    vsi_l_offset size = 0;
    const std::unique_ptr<GByte, VsiDeleter> bytes(VSIGetMemFileBuffer(name.c_str(), &size, TRUE));
    VSIUnlink((name + ".aux.xml").c_str());
    if (!bytes) return failed();
    return std::string(reinterpret_cast<const char*>(bytes.get()), size);
}

}  // namespace terrawalk
