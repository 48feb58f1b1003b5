// Shapes shared out over ranks: rank 0 reads them, each rank makes the clumps of
// its share, rank 0 gathers and writes them. The file is the same bytes for any
// number of ranks and threads.
//
//   mpirun -n 4 shared_out_cpp [--threads N] [--out FILE]
//
// The file holds, for each shape in order, 8 bytes of length (little-endian) and
// what morula_clump_serialize() gives.
#include <morula.hpp>

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

using Bytes = std::vector<std::uint8_t>;

/// Appends an item with its length before it.
void pack(Bytes &to, const Bytes &item) {
  for (int i = 0; i < 8; ++i)
    to.push_back(static_cast<std::uint8_t>(std::uint64_t{item.size()} >> (8 * i)));
  to.insert(to.end(), item.begin(), item.end());
}

/// Takes the item at `at`, and moves on behind it.
Bytes unpack(const Bytes &from, std::size_t &at) {
  std::uint64_t size = 0;
  for (int i = 0; i < 8; ++i) size |= std::uint64_t{from[at + static_cast<std::size_t>(i)]} << (8 * i);
  at += 8;
  const auto begin = from.begin() + static_cast<std::ptrdiff_t>(at);
  at += size;
  return Bytes(begin, begin + static_cast<std::ptrdiff_t>(size));
}

/// The particles: here stones and primitives, in a host the files of a folder.
std::vector<morula::Shape> particles() {
  std::vector<morula::Shape> all;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    all.push_back(morula::Shape::from_primitive("stone", {}, 32, seed));
  for (const char *name : {"tablet", "torus", "capsule", "ellipsoid"})
    all.push_back(morula::Shape::from_primitive(name, {}, 32));
  return all;
}

/// Rank 0 has a part for each rank; each gets its own.
Bytes scatter(const std::vector<Bytes> &parts) {
  std::vector<int> sizes, starts;
  Bytes all;
  for (const auto &part : parts) {
    starts.push_back(static_cast<int>(all.size()));
    sizes.push_back(static_cast<int>(part.size()));
    all.insert(all.end(), part.begin(), part.end());
  }
  int size = 0;
  MPI_Scatter(sizes.data(), 1, MPI_INT, &size, 1, MPI_INT, 0, MPI_COMM_WORLD);
  Bytes mine(static_cast<std::size_t>(size));
  MPI_Scatterv(all.data(), sizes.data(), starts.data(), MPI_BYTE, mine.data(), size, MPI_BYTE, 0,
               MPI_COMM_WORLD);
  return mine;
}

/// The part of each rank, on rank 0.
std::vector<Bytes> gather(const Bytes &mine, int rank, int ranks) {
  std::vector<int> sizes(static_cast<std::size_t>(ranks)), starts;
  const int size = static_cast<int>(mine.size());
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  int total = 0;
  for (const int s : sizes) {
    starts.push_back(total);
    total += s;
  }
  Bytes all(static_cast<std::size_t>(rank == 0 ? total : 0));
  MPI_Gatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE, 0,
              MPI_COMM_WORLD);
  std::vector<Bytes> parts;
  if (rank == 0)
    for (std::size_t r = 0; r < sizes.size(); ++r)
      parts.emplace_back(all.begin() + starts[r], all.begin() + starts[r] + sizes[r]);
  return parts;
}

void run(int rank, int ranks, int threads, const std::string &out) {
  std::vector<Bytes> shares(rank == 0 ? static_cast<std::size_t>(ranks) : 0);
  std::size_t count = 0;
  if (rank == 0)
    for (const auto &shape : particles())
      pack(shares[count++ % shares.size()], shape.serialize());

  const Bytes mine = scatter(shares);
  morula::ClumpOptions options;  // one thread a rank unless asked otherwise
  options.spheres = 20;
  options.threads = threads;
  morula::SolidOptions grid;
  grid.cells = 32;
  Bytes made;
  for (std::size_t at = 0; at < mine.size();) {
    const auto shape = morula::Shape::deserialize(unpack(mine, at));
    pack(made, morula::Clump(shape, options, grid).serialize());
  }

  const auto parts = gather(made, rank, ranks);
  if (rank != 0) return;
  std::vector<std::size_t> places(parts.size(), 0);
  Bytes file;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t owner = i % parts.size();
    const Bytes clump = unpack(parts[owner], places[owner]);
    std::printf("particle %zu of rank %zu: %zu spheres\n", i, owner,
                morula::Clump::deserialize(clump).size());
    pack(file, clump);
  }
  std::ofstream to(out, std::ios::binary);
  to.write(reinterpret_cast<const char *>(file.data()), static_cast<std::streamsize>(file.size()));
  if (!to.flush()) throw std::runtime_error("cannot write " + out);
}

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1, threads = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::string out = "clumps.bin";
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--threads") == 0) threads = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--out") == 0) out = argv[i + 1];
  }
  try {
    run(rank, ranks, threads, out);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "rank %d: %s\n", rank, error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}
